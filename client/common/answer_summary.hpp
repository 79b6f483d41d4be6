// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What came in answer to all clouds of a run.
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "graspd/handle_list_t.hpp"

namespace graspd {

class AnswerSummary {
 public:
  void add(const handle_list_t& list);

  [[nodiscard]] std::int64_t answers() const { return answers_; }

  /// Some lines: answers by status, latency and handles of the frames that were processed.
  [[nodiscard]] std::string str() const;

 private:
  std::int64_t answers_ = 0;
  std::int64_t processed_ = 0;
  std::int64_t handles_ = 0;
  std::map<std::int8_t, std::int64_t> by_status_;
  std::deque<double> latencies_s_;  // of processed frames, the newest ones
};

/// Whether a list comes from a frame that went through the pipeline.
[[nodiscard]] bool is_processed(const handle_list_t& list);

}  // namespace graspd
