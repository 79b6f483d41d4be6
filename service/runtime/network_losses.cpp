// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/network_losses.hpp"

#include <charconv>
#include <string>

#include "service/runtime/file_text.hpp"

namespace graspd {
namespace {

std::string_view take_until(std::string_view& rest, char end) {
  const std::size_t at = rest.find(end);
  const std::string_view taken = rest.substr(0, at);
  rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + 1);
  return taken;
}

NetworkLosses totals() {
  const std::string text = file_text("/proc/net/snmp");
  return {snmp_value(text, "Udp", "RcvbufErrors").value_or(-1),
          snmp_value(text, "Ip", "ReasmFails").value_or(-1)};
}

std::int64_t difference(std::int64_t now, std::int64_t start) {
  return now < 0 || start < 0 ? -1 : now - start;
}

}  // namespace

std::optional<std::int64_t> snmp_value(std::string_view text, std::string_view protocol,
                                       std::string_view name) {
  std::string_view names;
  while (!text.empty()) {
    std::string_view line = take_until(text, '\n');
    if (take_until(line, ':') != protocol) continue;
    if (names.empty()) {
      names = line;
      continue;
    }
    while (!names.empty() && !line.empty()) {
      const std::string_view value = take_until(line, ' ');
      if (take_until(names, ' ') != name) continue;
      std::int64_t number = 0;
      const auto result = std::from_chars(value.data(), value.data() + value.size(), number);
      if (result.ec == std::errc() && result.ptr == value.data() + value.size()) return number;
      return std::nullopt;
    }
    return std::nullopt;
  }
  return std::nullopt;
}

NetworkLossMeter::NetworkLossMeter() : start_(totals()) {}

NetworkLosses NetworkLossMeter::measure() const {
  const NetworkLosses now = totals();
  return {difference(now.receive_errors, start_.receive_errors),
          difference(now.reassembly_errors, start_.reassembly_errors)};
}

}  // namespace graspd
