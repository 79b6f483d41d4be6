// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the kernel of this network namespace could not deliver.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace graspd {

/// Datagrams since a meter was made; -1: the kernel does not say.
struct NetworkLosses {
  std::int64_t receive_errors = -1;     ///< a receive buffer was full
  std::int64_t reassembly_errors = -1;  ///< a piece was missing, or the space for pieces was full
};

/// Counts of all programs of the network namespace, not of this process alone: the kernel keeps no others.
class NetworkLossMeter {
 public:
  NetworkLossMeter();
  [[nodiscard]] NetworkLosses measure() const;

 private:
  const NetworkLosses start_;
};

/// A value of /proc/net/snmp, which has for each protocol a line of names and a line of values.
[[nodiscard]] std::optional<std::int64_t> snmp_value(std::string_view text, std::string_view protocol,
                                                     std::string_view name);

}  // namespace graspd
