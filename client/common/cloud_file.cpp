// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_file.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "client/common/pcd_reader.hpp"
#include "client/common/ply_reader.hpp"

namespace graspd {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open(const std::filesystem::path& path, const char* mode) {
  return {std::fopen(path.c_str(), mode), [](std::FILE* file) { return file ? std::fclose(file) : 0; }};
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw CloudFileError(path.string() + ": " + reason);
}

/// The whole file.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) fail(path, "no such file");
  if (error) fail(path, error.message());
  if (std::filesystem::is_directory(status)) fail(path, "is a folder, expected a PCD or PLY file");
  const auto size = std::filesystem::is_regular_file(status) ? std::filesystem::file_size(path, error) : 0;
  if (size > max_bytes) fail(path, "is larger than " + std::to_string(max_bytes) + " bytes");
  errno = 0;
  const File file = open(path, "rb");
  if (!file) fail(path, std::string("cannot be opened: ") + std::strerror(errno));
  std::string bytes(size, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  if (std::ferror(file.get())) fail(path, std::string("cannot be read: ") + std::strerror(errno));
  return bytes;
}

LabelledCloud parse(std::string_view bytes, const CloudFileLimits& limits) {
  if (bytes.empty()) throw std::runtime_error("is empty");
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n")) return parse_ply(bytes, limits);
  // A PCD starts with comments, and its header with one of these.
  const std::string_view start = bytes.substr(0, 1024);
  for (const std::string_view key : {"VERSION ", "FIELDS "}) {
    const auto at = start.find(key);
    if (at != start.npos && (at == 0 || start[at - 1] == '\n')) return parse_pcd(bytes, limits);
  }
  throw std::runtime_error("is neither a PCD nor a PLY file");
}

}  // namespace

bool is_cloud_file(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".pcd" || ending == ".ply";
}

LabelledCloud load_cloud(const std::filesystem::path& path, const CloudFileLimits& limits) {
  const std::string bytes = read_file(path, limits.max_file_bytes);
  try {
    return parse(bytes, limits);
  } catch (const std::runtime_error& error) {
    fail(path, error.what());
  }
}

void save_pcd(const std::filesystem::path& path, const LabelledCloud& labelled) {
  static_assert(std::endian::native == std::endian::little, "PCD's binary data is little-endian");
  const PointCloud& cloud = labelled.cloud;
  const bool rgb = !labelled.rgb.empty();
  const bool label = !labelled.label.empty();
  const auto extra = [&](const char* of_rgb, const char* of_label) {
    return std::string(rgb ? of_rgb : "") + (label ? of_label : "") + "\n";
  };
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n";
  text += "FIELDS x y z" + extra(" rgba", " label") + "SIZE 4 4 4" + extra(" 4", " 4");
  text += "TYPE F F F" + extra(" U", " U") + "COUNT 1 1 1" + extra(" 1", " 1");
  text += "WIDTH " + std::to_string(cloud.width) + "\nHEIGHT " + std::to_string(cloud.height) + "\n";
  char viewpoint[128];
  std::snprintf(viewpoint, sizeof viewpoint, "VIEWPOINT %.9g %.9g %.9g 1 0 0 0\n",
                double(cloud.viewpoint.x()), double(cloud.viewpoint.y()), double(cloud.viewpoint.z()));
  text += viewpoint + ("POINTS " + std::to_string(cloud.size())) + "\nDATA binary\n";
  const auto append = [&text](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  text.reserve(text.size() + cloud.size() * 20);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    append(cloud.x[i]);
    append(cloud.y[i]);
    append(cloud.z[i]);
    if (rgb) append(labelled.rgb[i]);
    if (label) append(labelled.label[i]);
  }
  errno = 0;
  const File file = open(path, "wb");
  if (!file) fail(path, std::string("cannot be created: ") + std::strerror(errno));
  const bool written =
      std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() && std::fflush(file.get()) == 0;
  if (!written) fail(path, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace graspd
