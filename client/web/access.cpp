// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/access.hpp"

#include <algorithm>
#include <charconv>
#include <random>

#include "client/common/text.hpp"

namespace graspd {
namespace {

/// Nothing where a percent code is wrong.
std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() < 2 || error != std::errc{} || end != digits.data() + 2) return std::nullopt;
    decoded += static_cast<char>(value);
    i += 2;
  }
  return decoded;
}

bool is_plain_path(std::string_view path) {
  if (!path.starts_with('/')) return false;
  const bool odd = std::any_of(path.begin(), path.end(), [](char c) {
    return static_cast<unsigned char>(c) <= 0x20 || c == '\\' || c == 0x7f;
  });
  if (odd || path.find("//") != std::string_view::npos) return false;
  return path.find("/.") == std::string_view::npos;
}

std::string query_token(std::string_view query) {
  constexpr std::string_view kName = "token=";
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view parameter = query.substr(0, end);
    if (parameter.starts_with(kName)) return percent_decoded(parameter.substr(kName.size())).value_or("");
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return {};
}

/// "localhost:80" without the port; "[::1]:80" as "[::1]".
std::string_view host_name(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, std::min(host.find(']'), host.size() - 1) + 1);
  return host.substr(0, host.find(':'));
}

bool same_origin(const RequestFacts& request) {
  return request.host && *request.origin == "http://" + std::string(*request.host);
}

}  // namespace

std::optional<Target> parse_target(std::string_view target) {
  const std::size_t question = target.find('?');
  const std::optional<std::string> path = percent_decoded(target.substr(0, question));
  if (!path || !is_plain_path(*path)) return std::nullopt;
  return Target{*path, question == std::string_view::npos ? "" : query_token(target.substr(question + 1))};
}

bool is_loopback(std::string_view address) {
  // A name like 127.example.org is anybody's.
  const bool is_ipv4 = address.find_first_not_of("0123456789.") == std::string_view::npos;
  return (is_ipv4 && address.starts_with("127.")) || address == "::1" || address == "localhost";
}

bool equal_secrets(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

std::string draw_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += printed("%08x", device());
  return token;
}

std::optional<WebEvent> check_host(const AccessRules& rules, const RequestFacts& request) {
  if (!request.host) return WebEvent::kBadRequest;
  const std::string_view name = host_name(*request.host);
  if (!rules.local || name == "[::1]" || is_loopback(name)) return std::nullopt;
  return WebEvent::kForeignHost;
}

SocketAccess check_socket(const AccessRules& rules, const RequestFacts& request, const Target& target) {
  const auto& known = rules.origins;
  if (request.origin && !same_origin(request) &&
      std::find(known.begin(), known.end(), *request.origin) == known.end())
    return {WebEvent::kForeignOrigin};
  constexpr std::string_view kBearer = "Bearer ";
  std::string_view shown = target.token;
  if (request.authorization && request.authorization->starts_with(kBearer))
    shown = request.authorization->substr(kBearer.size());
  const bool right = !rules.token.empty() && equal_secrets(shown, rules.token);
  // Who shows a wrong one is told so, also where reading would need none.
  if (!right && (!rules.local || !shown.empty())) return {WebEvent::kBadToken};
  return {std::nullopt, right};
}

}  // namespace graspd
