// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Depth images in types of others -> Frame: bot_core's images_t, Drake's lcmt_image_array. The first depth
// image of a message counts; intrinsics are the configuration's.
#pragma once
#include "service/transport/cloud_type.hpp"

namespace graspd {

[[nodiscard]] CloudType images_type();
[[nodiscard]] CloudType lcmt_image_array_type();

}  // namespace graspd
