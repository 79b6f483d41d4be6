// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/answer_summary.hpp"

#include <vector>

#include "client/common/handle_text.hpp"
#include "client/common/text.hpp"

namespace graspd {

namespace {
// Enough for an hour at 15 Hz; a listener may run for months.
constexpr std::size_t kMaxLatencies = 65'536;
}  // namespace

bool is_processed(const handle_list_t& list) {
  return list.status != handle_list_t::REFUSED && list.status != handle_list_t::OVERLOADED &&
         list.status != handle_list_t::FAILED;
}

void AnswerSummary::add(const handle_list_t& list) {
  ++answers_;
  ++by_status_[list.status];
  if (!is_processed(list)) return;
  ++processed_;
  handles_ += static_cast<std::int64_t>(list.handles.size());
  latencies_s_.push_back(list.latency);
  if (latencies_s_.size() > kMaxLatencies) latencies_s_.pop_front();
}

std::string AnswerSummary::str() const {
  std::string text = printed("answers           %lld", static_cast<long long>(answers_));
  const char* separator = ": ";
  for (const auto& [status, count] : by_status_) {
    text += separator + std::string(status_name(status)) + printed(" %lld", static_cast<long long>(count));
    separator = ", ";
  }
  const std::vector<double> latencies(latencies_s_.begin(), latencies_s_.end());
  text += printed("\nlatency           p50 %.1f ms, p99 %.1f ms\n", 1e3 * percentile(latencies, 0.5),
                  1e3 * percentile(latencies, 0.99));
  const double per_frame =
      processed_ > 0 ? static_cast<double>(handles_) / static_cast<double>(processed_) : 0;
  return text + printed("handles per frame %.1f\n", per_frame);
}

}  // namespace graspd
