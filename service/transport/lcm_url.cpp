// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/lcm_url.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include "service/transport/file_descriptor.hpp"

namespace graspd {
namespace {

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* kReceiveBufferOption = "recv_buf_size";
constexpr int kReceiveBufferBytes = 4 << 20;

[[noreturn]] void fail(const std::string& url, const std::string& reason) {
  throw std::runtime_error("LCM URL '" + url + "': " + reason);
}

bool parse_int(const std::string& text, int& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

std::map<std::string, std::string> parse_options(const std::string& text) {
  std::map<std::string, std::string> options;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find_first_of("&,", begin), text.size());
    const std::string entry = text.substr(begin, end - begin);
    const std::size_t equals = std::min(entry.find('='), entry.size());
    if (equals > 0) options[entry.substr(0, equals)] = entry.substr(std::min(equals + 1, entry.size()));
    begin = end + 1;
  }
  return options;
}

/// What the kernel makes of a wish for a receive buffer; it reports twice that. 0 when it cannot be found
/// out.
int granted_receive_buffer(int wanted) {
  const FileDescriptor fd(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (fd.get() < 0) return 0;
  int granted = 0;
  socklen_t length = sizeof(granted);
  const bool known =
      (wanted == 0 || setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &wanted, sizeof(wanted)) == 0) &&
      getsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &granted, &length) == 0;
  return known ? granted / 2 : 0;
}

}  // namespace

LcmUrl parse_lcm_url(const std::string& url) {
  const std::size_t separator = url.find("://");
  if (separator == std::string::npos || separator == 0) {
    fail(url,
         "no LCM URL (expected provider://network?options, for example " + std::string(kDefaultUrl) + ")");
  }
  LcmUrl result;
  result.provider = url.substr(0, separator);
  const std::string rest = url.substr(separator + 3);
  const std::size_t question = std::min(rest.find('?'), rest.size());
  result.network = rest.substr(0, question);
  if (question < rest.size()) result.options = parse_options(rest.substr(question + 1));
  return result;
}

MulticastGroup multicast_group(const std::string& url) {
  const std::string network = parse_lcm_url(url).network;
  MulticastGroup group;
  const std::size_t colon = std::min(network.find(':'), network.size());
  if (colon > 0) group.address = network.substr(0, colon);
  in_addr address{};
  if (inet_pton(AF_INET, group.address.c_str(), &address) != 1 || !IN_MULTICAST(ntohl(address.s_addr))) {
    fail(url, "no multicast group (got '" + group.address + "', expected 224.0.0.0 to 239.255.255.255)");
  }
  if (colon + 1 < network.size()) {
    int port = 0;
    if (!parse_int(network.substr(colon + 1), port) || port < 1 || port > 65535) {
      fail(url, "no port (got '" + network.substr(colon + 1) + "', expected 1 to 65535)");
    }
    group.port = static_cast<std::uint16_t>(port);
  }
  return group;
}

std::string resolve_lcm_url(const std::string& option) {
  const char* from_environment = std::getenv("LCM_DEFAULT_URL");
  std::string url = option;
  if (url.empty() && from_environment != nullptr) url = from_environment;
  if (url.empty()) url = kDefaultUrl;
  if (!url.starts_with("udpm://") || parse_lcm_url(url).options.contains(kReceiveBufferOption)) return url;
  const char* separator = "?";
  if (url.find('?') != std::string::npos) separator = url.ends_with('?') || url.ends_with('&') ? "" : "&";
  return url + separator + kReceiveBufferOption + "=" + std::to_string(kReceiveBufferBytes);
}

std::vector<std::string> receive_buffer_warnings(const std::string& url) {
  const LcmUrl parsed = parse_lcm_url(url);
  if (parsed.provider != "udpm") return {};
  const auto option = parsed.options.find(kReceiveBufferOption);
  int wanted = 0;
  if (option != parsed.options.end() && (!parse_int(option->second, wanted) || wanted < 0)) {
    fail(url, "no recv_buf_size (got '" + option->second + "', expected bytes)");
  }
  const int granted = granted_receive_buffer(wanted);
  const int needed = wanted > 0 ? wanted : kReceiveBufferBytes;
  if (granted == 0 || granted >= needed) return {};
  const std::string size = std::to_string(needed);
  if (wanted == 0) {
    return {"LCM receive buffer is the kernel's default of " + std::to_string(granted) +
            " bytes, large clouds will be lost; remedy: add recv_buf_size=" + size + " to the LCM URL"};
  }
  return {"LCM receive buffer is cut from " + size + " to " + std::to_string(granted) +
          " bytes, large clouds will be lost; remedy: sysctl -w net.core.rmem_max=" + size};
}

}  // namespace graspd
