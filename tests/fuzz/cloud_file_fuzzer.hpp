// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What must hold of whatever a reader of cloud files makes of any bytes.
#pragma once
#include <stdexcept>
#include <string_view>

#include "client/common/cloud_file.hpp"
#include "tests/fuzz/fuzzer.hpp"

namespace graspd {

/// A file is a whole cloud, or refused with a reason.
template <class Parse>
void check_cloud_file(const std::uint8_t* data, std::size_t size, const Parse& parse) {
  try {
    const LabelledCloud read = parse(std::string_view(reinterpret_cast<const char*>(data), size));
    const PointCloud& cloud = read.cloud;
    require(cloud.y.size() == cloud.size() && cloud.z.size() == cloud.size());
    require(cloud.size() == static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height));
    require(read.rgb.empty() || read.rgb.size() == cloud.size());
    require(read.label.empty() || read.label.size() == cloud.size());
    require(cloud.viewpoint.allFinite());
  } catch (const std::runtime_error& error) {
    const std::string_view text = error.what();
    require(!text.empty() && text.size() < 1000 && text.find('\n') == text.npos);
  }
}

}  // namespace graspd
