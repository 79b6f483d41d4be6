// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_file.hpp"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "client/common/cloud_file_check.hpp"

namespace graspd {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw CloudFileError(path.string() + ": " + reason);
}

const pcl::PCLPointField* find_field(const pcl::PCLPointCloud2& blob, std::string_view name) {
  for (const auto& field : blob.fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

template <class T>
T value_at(const pcl::PCLPointCloud2& blob, std::size_t point, const pcl::PCLPointField& field) {
  T value;
  std::memcpy(&value, blob.data.data() + point * blob.point_step + field.offset, sizeof(T));
  return value;
}

/// A coordinate; NaN for integer types, which no cloud uses.
float coordinate(const pcl::PCLPointCloud2& blob, std::size_t point, const pcl::PCLPointField& field) {
  if (field.datatype == pcl::PCLPointField::FLOAT64)
    return static_cast<float>(value_at<double>(blob, point, field));
  return value_at<float>(blob, point, field);
}

std::uint32_t integer(const pcl::PCLPointCloud2& blob, std::size_t point, const pcl::PCLPointField& field) {
  switch (field.datatype) {
    case pcl::PCLPointField::INT8:
    case pcl::PCLPointField::UINT8:
      return value_at<std::uint8_t>(blob, point, field);
    case pcl::PCLPointField::INT16:
    case pcl::PCLPointField::UINT16:
      return value_at<std::uint16_t>(blob, point, field);
    case pcl::PCLPointField::INT32:
    case pcl::PCLPointField::UINT32:
      return value_at<std::uint32_t>(blob, point, field);
    case pcl::PCLPointField::FLOAT32: {
      const float value = value_at<float>(blob, point, field);
      return value >= 0 && value < 4e9f ? static_cast<std::uint32_t>(value) : 0;
    }
    default:
      return 0;
  }
}

void copy_coordinates(const pcl::PCLPointCloud2& blob, const std::filesystem::path& path, PointCloud& cloud) {
  const std::array fields{find_field(blob, "x"), find_field(blob, "y"), find_field(blob, "z")};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!fields[axis]) fail(path, std::string("has no field ") + "xyz"[axis]);
    const auto type = fields[axis]->datatype;
    if (type != pcl::PCLPointField::FLOAT32 && type != pcl::PCLPointField::FLOAT64) {
      fail(path, std::string("its field ") + "xyz"[axis] + " is not of a floating-point type");
    }
  }
  cloud.resize(std::size_t{blob.width} * blob.height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.x[i] = coordinate(blob, i, *fields[0]);
    cloud.y[i] = coordinate(blob, i, *fields[1]);
    cloud.z[i] = coordinate(blob, i, *fields[2]);
  }
}

/// Colours are packed, also where the field is declared a float.
std::vector<std::uint32_t> colors(const pcl::PCLPointCloud2& blob, std::size_t n) {
  const pcl::PCLPointField* field = find_field(blob, "rgba");
  if (!field) field = find_field(blob, "rgb");
  if (!field || pcl::getFieldSize(field->datatype) != 4) return {};
  std::vector<std::uint32_t> rgb(n);
  for (std::size_t i = 0; i < n; ++i) rgb[i] = value_at<std::uint32_t>(blob, i, *field) & 0xffffff;
  return rgb;
}

std::vector<std::uint32_t> labels(const pcl::PCLPointCloud2& blob, std::size_t n) {
  const pcl::PCLPointField* field = find_field(blob, "label");
  if (!field) return {};
  std::vector<std::uint32_t> label(n);
  for (std::size_t i = 0; i < n; ++i) label[i] = integer(blob, i, *field);
  return label;
}

struct Blob {
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
};

Blob read_with_pcl(const std::filesystem::path& path, CloudFormat format) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  Blob blob;
  Eigen::Quaternionf orientation;
  int version = 0;
  int result = -1;
  try {
    if (format == CloudFormat::kPcd) {
      result = pcl::PCDReader().read(path.string(), blob.cloud, blob.origin, orientation, version);
    } else {
      result = pcl::PLYReader().read(path.string(), blob.cloud, blob.origin, orientation, version);
    }
  } catch (const std::exception&) {
    // What PCL throws names its own functions, not what is wrong with the file.
    result = -1;
  }
  const bool fits =
      blob.cloud.data.size() >= std::size_t{blob.cloud.width} * blob.cloud.height * blob.cloud.point_step;
  if (result < 0 || !fits) fail(path, "damaged: its points cannot be read");
  return blob;
}

bool is_whole(const pcl::PCLPointCloud2& blob) {
  return std::all_of(blob.fields.begin(), blob.fields.end(), [&](const pcl::PCLPointField& field) {
    const auto size = static_cast<std::size_t>(std::max(0, pcl::getFieldSize(field.datatype)));
    return std::size_t{field.offset} + size <= blob.point_step;
  });
}

}  // namespace

bool is_cloud_file(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".pcd" || ending == ".ply";
}

LabelledCloud load_cloud(const std::filesystem::path& path) {
  const CloudFormat format = sniff_format(path);
  format == CloudFormat::kPcd ? check_pcd(path) : check_ply(path);
  const Blob blob = read_with_pcl(path, format);
  if (!is_whole(blob.cloud)) fail(path, "damaged: a field reaches beyond its point");
  LabelledCloud result;
  copy_coordinates(blob.cloud, path, result.cloud);
  result.cloud.width = static_cast<int>(blob.cloud.width);
  result.cloud.height = static_cast<int>(blob.cloud.height);
  result.cloud.viewpoint = blob.origin.head<3>();
  if (!result.cloud.viewpoint.allFinite()) fail(path, "its viewpoint is not finite");
  result.rgb = colors(blob.cloud, result.cloud.size());
  result.label = labels(blob.cloud, result.cloud.size());
  return result;
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
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.c_str(), "wb"), [](std::FILE* f) { return f ? std::fclose(f) : 0; });
  if (!file) fail(path, std::string("cannot be created: ") + std::strerror(errno));
  const bool written =
      std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() && std::fflush(file.get()) == 0;
  if (!written) fail(path, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace graspd
