// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One small cloud with everything a cloud file can hold, as ours and as PCL's, and what readers say of bad
// bytes.
#pragma once
#include <string>

#include "client/common/cloud_file.hpp"

namespace pcl {
template <class PointT>
class PointCloud;
struct PointXYZRGBL;
}  // namespace pcl

namespace graspd {

/// 8 x 6 points with two holes, colours, labels and a viewpoint.
[[nodiscard]] LabelledCloud sample_cloud();
[[nodiscard]] pcl::PointCloud<pcl::PointXYZRGBL> pcl_sample_cloud();

/// The line that parsing these bytes fails with; "loaded" when it does not.
[[nodiscard]] std::string parse_failure(const std::string& bytes);

}  // namespace graspd
