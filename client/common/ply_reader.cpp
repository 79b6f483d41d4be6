// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/ply_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <type_traits>

#include "client/common/ply_header.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

[[noreturn]] void fail(const std::string& reason) {
  throw std::runtime_error(reason);
}

/// Values one after the other, in any of the three formats.
class ValueReader {
 public:
  ValueReader(std::string_view data, PlyFormat format) : data_(data), format_(format) {}

  [[nodiscard]] std::size_t bytes_left() const { return data_.size(); }

  double next(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return value<std::int8_t>();
      case PlyType::kUint8:
        return value<std::uint8_t>();
      case PlyType::kInt16:
        return value<std::int16_t>();
      case PlyType::kUint16:
        return value<std::uint16_t>();
      case PlyType::kInt32:
        return value<std::int32_t>();
      case PlyType::kUint32:
        return value<std::uint32_t>();
      case PlyType::kFloat32:
        return static_cast<double>(value<float>());
      case PlyType::kFloat64:
        return value<double>();
    }
    return 0;
  }

  void skip_list(const PlyProperty& list) {
    const double count = next(list.count_type);
    if (count < 0 || count > static_cast<double>(data_.size())) fail("damaged: a list of impossible length");
    for (double i = 0; i < count; ++i) (void)next(list.type);
  }

 private:
  template <class T>
  T value() {
    return format_ == PlyFormat::kAscii ? from_text<T>() : from_bytes<T>();
  }

  template <class T>
  T from_bytes() {
    std::array<char, sizeof(T)> raw;
    if (data_.size() < raw.size()) fail("ends too early");
    std::copy_n(data_.begin(), raw.size(), raw.begin());
    data_.remove_prefix(raw.size());
    if (format_ == PlyFormat::kBigEndian) std::reverse(raw.begin(), raw.end());
    T result;
    std::memcpy(&result, raw.data(), sizeof result);
    return result;
  }

  template <class T>
  T from_text() {
    const std::string_view word = next_word(data_);
    if (word.empty()) fail("ends too early");
    T result{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), result);
    const bool out_of_range = std::is_floating_point_v<T> && error == std::errc::result_out_of_range;
    if (end != word.data() + word.size() || (error != std::errc() && !out_of_range)) {
      fail("damaged: '" + plain_line(word.substr(0, 40)) + "' is no number of its property's type");
    }
    return result;
  }

  std::string_view data_;
  PlyFormat format_;
};

/// Calls use(row, property index, value) for every scalar of an element.
template <class Use>
void read_element(ValueReader& values, const PlyElement& element, const Use& use) {
  if (element.properties.empty()) return;
  for (std::size_t row = 0; row < element.count; ++row) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.is_list) {
        values.skip_list(property);
      } else {
        use(row, p, values.next(property.type));
      }
    }
  }
}

/// What a property of a vertex is for.
enum class Role { kNone, kX, kY, kZ, kRed, kGreen, kBlue, kLabel };

Role role_of(const PlyProperty& property) {
  static const std::map<std::string_view, Role> kRoles{{"x", Role::kX},
                                                       {"y", Role::kY},
                                                       {"z", Role::kZ},
                                                       {"red", Role::kRed},
                                                       {"green", Role::kGreen},
                                                       {"blue", Role::kBlue},
                                                       {"diffuse_red", Role::kRed},
                                                       {"diffuse_green", Role::kGreen},
                                                       {"diffuse_blue", Role::kBlue},
                                                       {"label", Role::kLabel}};
  const auto role = kRoles.find(property.name);
  return role == kRoles.end() || property.is_list ? Role::kNone : role->second;
}

std::uint32_t whole(double value, double max) {
  return value >= 0 && value <= max ? static_cast<std::uint32_t>(value) : 0;
}

void read_vertices(ValueReader& values, const PlyElement& element, PlyFormat format, LabelledCloud& result) {
  std::vector<Role> roles;
  for (const PlyProperty& property : element.properties) roles.push_back(role_of(property));
  const auto has = [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
  for (const auto& [role, name] : {std::pair{Role::kX, 'x'}, {Role::kY, 'y'}, {Role::kZ, 'z'}}) {
    if (!has(role)) fail(std::string("has no property ") + name);
  }
  const std::size_t least = element.count * element.least_bytes(format);
  if (values.bytes_left() + 1 < least) {
    fail("ends too early: " + std::to_string(values.bytes_left()) + " bytes of points, expected " +
         std::to_string(least));
  }
  PointCloud& cloud = result.cloud;
  cloud.resize(element.count);
  if (has(Role::kRed) && has(Role::kGreen) && has(Role::kBlue)) result.rgb.resize(element.count);
  if (has(Role::kLabel)) result.label.resize(element.count);
  read_element(values, element, [&](std::size_t i, std::size_t p, double value) {
    const auto shade = [&](int shift) {
      if (!result.rgb.empty()) result.rgb[i] |= whole(value, 255) << shift;
    };
    switch (roles[p]) {
      case Role::kNone:
        break;
      case Role::kX:
        cloud.x[i] = static_cast<float>(value);
        break;
      case Role::kY:
        cloud.y[i] = static_cast<float>(value);
        break;
      case Role::kZ:
        cloud.z[i] = static_cast<float>(value);
        break;
      case Role::kRed:
        shade(16);
        break;
      case Role::kGreen:
        shade(8);
        break;
      case Role::kBlue:
        shade(0);
        break;
      case Role::kLabel:
        result.label[i] = whole(value, 4294967295.0);
        break;
    }
  });
}

/// Viewpoint and organization as PCL writes them.
void read_camera(ValueReader& values, const PlyElement& element, PointCloud& cloud) {
  std::map<std::string_view, double> camera;
  read_element(values, element,
               [&](std::size_t, std::size_t p, double value) { camera[element.properties[p].name] = value; });
  const Eigen::Vector3d viewpoint(camera["view_px"], camera["view_py"], camera["view_pz"]);
  if (!viewpoint.allFinite() || viewpoint.cwiseAbs().maxCoeff() >= 1e6)
    fail("its camera's position is no place");
  cloud.viewpoint = viewpoint.cast<float>();
  const double width = camera["viewportx"], height = camera["viewporty"];
  if (height < 1 || width * height != static_cast<double>(cloud.size())) return;
  if (width != std::floor(width) || height != std::floor(height)) return;
  cloud.width = static_cast<int>(width);
  cloud.height = static_cast<int>(height);
}

}  // namespace

LabelledCloud parse_ply(std::string_view file, const CloudFileLimits& limits) {
  const PlyHeader header = parse_ply_header(file);
  ValueReader values(file.substr(header.data_start), header.format);
  LabelledCloud result;
  bool has_vertices = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && !has_vertices) {
      if (element.count > limits.max_points) {
        fail("has " + std::to_string(element.count) + " points, expected at most " +
             std::to_string(limits.max_points));
      }
      read_vertices(values, element, header.format, result);
      result.cloud.width = static_cast<int>(element.count);
      has_vertices = true;
    } else if (element.name == "camera" && has_vertices) {
      read_camera(values, element, result.cloud);
      break;  // The rest says nothing about points.
    } else {
      read_element(values, element, [](std::size_t, std::size_t, double) {});
    }
  }
  if (!has_vertices) fail("the PLY header has no element vertex");
  return result;
}

}  // namespace graspd
