// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A look at a cloud file's header before PCL reads it, so that lying sizes cost neither memory nor a crash.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace graspd {

enum class CloudFormat { kPcd, kPly };

/// What kind of file it is by its first bytes. Throws CloudFileError when it cannot be opened, is empty or is
/// neither.
[[nodiscard]] CloudFormat sniff_format(const std::filesystem::path& path);

/// Throw CloudFileError unless the header is whole and the file is long enough for the points that it
/// promises.
void check_pcd(const std::filesystem::path& path);
void check_ply(const std::filesystem::path& path);

}  // namespace graspd
