// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A network namespace of one's own for a test: what happens in it leaves no trace and meets nobody.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace graspd {

struct PrivateNetworkResult {
  std::string text;     ///< what the body returned
  std::string problem;  ///< why it could not run; empty: it did
  bool denied = false;  ///< the kernel gives no namespace: nothing was tested
};

/// Forks, unshares the network, runs the shell command and then the body. Call while there is one thread.
[[nodiscard]] PrivateNetworkResult in_private_network(const std::string& setup_command,
                                                      const std::function<std::string()>& body);

inline constexpr const char* kNoSetup = "true";
inline constexpr const char* kLoopback = "ip link set lo up";
inline constexpr const char* kMulticast = "ip link set lo up && ip route add 239.0.0.0/8 dev lo";
/// There is a route, and nothing comes back.
inline constexpr const char* kBlockedMulticast =
    "ip link set lo up && ip route add 239.0.0.0/8 dev lo && tc qdisc add dev lo root blackhole";

}  // namespace graspd
