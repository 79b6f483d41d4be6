// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handle lists for people, and as JSON.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "graspd/handle_list_t.hpp"

namespace graspd {

class JsonWriter;

/// OK, NO_HANDLES, ...: the name of a handle_list_t's status; UNKNOWN for other values.
[[nodiscard]] std::string_view status_name(std::int8_t status);

/// One line: frame, status, counts, latency; no newline.
[[nodiscard]] std::string handle_list_line(const handle_list_t& list);

/// A table of the best handles, angles in degrees, lengths in millimetres; empty without handles.
[[nodiscard]] std::string handle_table(const handle_list_t& list, std::size_t max_rows);

/// Everything in the list, in one line, under the names of the wire type; no newline.
[[nodiscard]] std::string handle_list_json(const handle_list_t& list);

/// The same as members of the object that is open.
void write_handle_list(JsonWriter& json, const handle_list_t& list);

}  // namespace graspd
