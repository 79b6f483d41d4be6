// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which LCM network: the URL, its defaults, and what in the machine's settings stands in its way.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace graspd {

/// provider://network?key=value&...
struct LcmUrl {
  std::string provider;
  std::string network;
  std::map<std::string, std::string> options;
};

/// Throws std::runtime_error that names the URL and what is wrong with it.
[[nodiscard]] LcmUrl parse_lcm_url(const std::string& url);

/// A udpm URL's group and port, LCM's defaults where absent.
struct MulticastGroup {
  std::string address = "239.255.76.67";
  std::uint16_t port = 7667;
};

/// Throws std::runtime_error that names the URL and what is wrong with it.
[[nodiscard]] MulticastGroup multicast_group(const std::string& url);

/// The option, else the environment's LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0. udpm URLs
/// without a recv_buf_size get 4 MiB: with the kernel's default nearly all large clouds are lost.
[[nodiscard]] std::string resolve_lcm_url(const std::string& option);

/// One line each for people, none when all is well: the kernel cuts receive buffers down to net.core.rmem_max
/// and tells nobody.
[[nodiscard]] std::vector<std::string> receive_buffer_warnings(const std::string& url);

}  // namespace graspd
