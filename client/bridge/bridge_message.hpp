// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What goes over the bridge's WebSockets: JSON texts out, control messages in.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "graspd/control_t.hpp"

namespace graspd {

/// {"type":"hello","version":"0.1.0","may_write":false}: the first text of every connection.
[[nodiscard]] std::string hello_text(bool may_write);

/// {"type":"handle_list","channel":"GRASPD_HANDLES","message":{...}}. message: one JSON value, as
/// graspd-listen and graspd-status write it.
[[nodiscard]] std::string envelope(std::string_view type, std::string_view channel, std::string_view message);

/// {"type":"sent","id":7}: a control message went out; the daemon's status repeats the number.
[[nodiscard]] std::string sent_text(std::int64_t id);

/// {"type":"refused","why":"..."}.
[[nodiscard]] std::string refused_text(std::string_view why);

/// {"type":"control","command":"set","text":"..."} with a command reload, set, undo or reset, and a text with
/// set alone. Nothing unless it is just that; `why` then says what is wrong. utime and id are left 0. Trusts
/// nothing in the text.
[[nodiscard]] std::optional<control_t> parse_control(std::string_view text, std::string& why);

}  // namespace graspd
