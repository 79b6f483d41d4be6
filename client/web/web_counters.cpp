// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/web_counters.hpp"

namespace graspd {

std::string_view name(WebEvent event) {
  constexpr std::array<std::string_view, kNumWebEvents> kNames{
      "connections",   "files",         "clients",         "messages_in",     "messages_out",
      "bytes_out",     "replaced",      "not_found",       "bad_requests",    "bad_methods",
      "bad_paths",     "foreign_hosts", "foreign_origins", "bad_tokens",      "too_many",
      "huge_messages", "floods",        "overflows",       "refused_messages"};
  return kNames[static_cast<std::size_t>(event)];
}

}  // namespace graspd
