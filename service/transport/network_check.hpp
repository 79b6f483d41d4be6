// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What in the machine's settings stands in the way of large messages.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace graspd {

struct NetworkWarning {
  std::string kind;  ///< lower_snake
  std::string text;  ///< one line with the command that mends it
};

/// None when all is well. A missing multicast route is told by LcmBus.
[[nodiscard]] std::vector<NetworkWarning> network_warnings(const std::string& url);

/// For a kernel that keeps so many bytes of datagrams whose pieces have not all come. Messages that stay on
/// this machine (ttl 0) are not cut into pieces.
[[nodiscard]] std::optional<NetworkWarning> fragment_warning(const std::string& url,
                                                             std::int64_t ipfrag_high_thresh);

}  // namespace graspd
