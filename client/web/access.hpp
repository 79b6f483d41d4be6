// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Who may do what: decides about a request by its headers alone.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/web/web_counters.hpp"

namespace graspd {

/// The parts of a request that the decision needs; nothing: the header is not there.
struct RequestFacts {
  std::string_view target;
  std::optional<std::string_view> host;
  std::optional<std::string_view> origin;
  std::optional<std::string_view> authorization;
};

/// "/a/b?token=1" taken apart, percent-decoded.
struct Target {
  std::string path;
  std::string token;  ///< the query's parameter of that name
};

/// Nothing unless it is a path of plain names: no empty, "." or ".." part, no name that starts with a dot, no
/// backslash, no control character, and no wrong percent code.
[[nodiscard]] std::optional<Target> parse_target(std::string_view target);

/// Whether an address is one of this machine alone.
[[nodiscard]] bool is_loopback(std::string_view address);

/// In a time that depends on the lengths alone.
[[nodiscard]] bool equal_secrets(std::string_view a, std::string_view b);

/// 128 random bits, in hexadecimal.
[[nodiscard]] std::string draw_token();

struct AccessRules {
  bool local = true;  ///< listening on a loopback address
  std::string token;
  std::vector<std::string> origins;
};

/// A request by any name but those of the loopback is refused where the server is local, so that no page gets
/// through by a name that it makes point to us.
[[nodiscard]] std::optional<WebEvent> check_host(const AccessRules& rules, const RequestFacts& request);

struct SocketAccess {
  std::optional<WebEvent> refusal;
  bool may_write = false;  ///< showed the token
};

/// For a request that wants a WebSocket: the origin, where there is one, must be our own or a listed one; the
/// token comes in the query or as "Authorization: Bearer".
[[nodiscard]] SocketAccess check_socket(const AccessRules& rules, const RequestFacts& request,
                                        const Target& target);

}  // namespace graspd
