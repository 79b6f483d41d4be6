// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/network_check.hpp"

#include <fstream>

#include "service/transport/lcm_url.hpp"

namespace graspd {
namespace {

// A message of 5 MB is 3500 pieces on Ethernet; with the kernel's 4 MB one lost piece makes the next ones
// lost, too.
constexpr std::int64_t kEnoughBytes = std::int64_t{64} << 20;
constexpr const char* kMend = "sysctl -w net.ipv4.ipfrag_high_thresh=268435456";

std::int64_t kernel_ipfrag_high_thresh() {
  std::ifstream file("/proc/sys/net/ipv4/ipfrag_high_thresh");
  std::int64_t bytes = 0;
  return file >> bytes ? bytes : kEnoughBytes;
}

}  // namespace

std::optional<NetworkWarning> fragment_warning(const std::string& url, std::int64_t ipfrag_high_thresh) {
  const LcmUrl parsed = parse_lcm_url(url);
  const auto ttl = parsed.options.find("ttl");
  const bool stays_here = ttl == parsed.options.end() || ttl->second.empty() || ttl->second == "0";
  if (parsed.provider != "udpm" || stays_here || ipfrag_high_thresh >= kEnoughBytes) return std::nullopt;
  return NetworkWarning{"fragment_space",
                        "the kernel keeps " + std::to_string(ipfrag_high_thresh) +
                            " bytes of datagrams in pieces, large clouds from other machines will be "
                            "lost when one piece is; remedy: " +
                            kMend};
}

std::vector<NetworkWarning> network_warnings(const std::string& url) {
  std::vector<NetworkWarning> warnings;
  for (const std::string& text : receive_buffer_warnings(url)) warnings.push_back({"receive_buffer", text});
  if (const auto warning = fragment_warning(url, kernel_ipfrag_high_thresh())) warnings.push_back(*warning);
  return warnings;
}

}  // namespace graspd
