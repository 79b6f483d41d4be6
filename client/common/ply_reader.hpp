// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The points of a PLY file. Read here and not by PCL, whose reader loses the viewpoint and trusts what it
// reads.
#pragma once
#include <string_view>

#include "client/common/cloud_file.hpp"

namespace graspd {

/// The vertices in the bytes of a PLY file: x, y, z, red, green, blue, label where they are; viewpoint and
/// organization from an element `camera` as PCL writes it. Throws std::runtime_error that says what is wrong.
[[nodiscard]] LabelledCloud parse_ply(std::string_view file, const CloudFileLimits& limits = {});

}  // namespace graspd
