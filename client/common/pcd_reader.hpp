// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The points of a PCD file. Read here and not by PCL, whose reader crashes on damaged files.
#pragma once
#include <string>
#include <string_view>

#include "client/common/cloud_file.hpp"

namespace graspd {

/// The cloud in the bytes of a PCD file. Throws std::runtime_error that says what is wrong.
[[nodiscard]] LabelledCloud parse_pcd(std::string_view file, const CloudFileLimits& limits = {});

/// Unpacks LZF data; false unless it fills `out` exactly.
[[nodiscard]] bool lzf_unpack(std::string_view in, std::string& out);

}  // namespace graspd
