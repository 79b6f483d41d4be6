// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Clouds in files: PCD and PLY in, binary PCD out.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// A cloud with what clients carry along; rgb and label are empty or hold one value a point.
struct LabelledCloud {
  PointCloud cloud;
  std::vector<std::uint32_t> rgb;    ///< 0x00RRGGBB
  std::vector<std::uint32_t> label;  ///< mOSD convention: 0 invalid, 1-9 support, 10 k ... 10 k + 9 object k
};

/// What a file may take, whatever its header promises.
struct CloudFileLimits {
  std::size_t max_file_bytes = std::size_t{4} << 30;
  std::size_t max_points = 100'000'000;
  std::size_t max_unpacked_bytes = std::size_t{4} << 30;  ///< of points that are not in the file as they are
};

/// A file that cannot be used; what() is one line: `path: reason`.
class CloudFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether the ending is one of a cloud file's, in any case.
[[nodiscard]] bool is_cloud_file(const std::filesystem::path& path);

/// Reads PCD (ascii, binary, compressed) and PLY, told apart by their first bytes. Organization and NaNs are
/// kept; the viewpoint is the file's. Throws CloudFileError for whatever is wrong, and prints nothing.
[[nodiscard]] LabelledCloud load_cloud(const std::filesystem::path& path, const CloudFileLimits& limits = {});

/// Writes a binary PCD with x, y, z, and rgba and label where there are any. Throws CloudFileError.
void save_pcd(const std::filesystem::path& path, const LabelledCloud& cloud);

}  // namespace graspd
