// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/pcd_reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "client/common/pcd_header.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD's binary data is little-endian");

[[noreturn]] void fail(const std::string& reason) {
  throw std::runtime_error(reason);
}

[[noreturn]] void fail_short(std::size_t got, std::size_t expected) {
  fail("ends too early: " + std::to_string(got) + " bytes of points, expected " + std::to_string(expected));
}

/// One field of all points: element i at start + i * stride.
struct Column {
  const PcdField* field = nullptr;
  const char* start = nullptr;
  std::size_t stride = 0;

  template <class T>
  [[nodiscard]] T at(std::size_t i) const {
    T value;
    std::memcpy(&value, start + i * stride, sizeof value);
    return value;
  }

  [[nodiscard]] float real(std::size_t i) const {
    return field->size == 8 ? static_cast<float>(at<double>(i)) : at<float>(i);
  }

  [[nodiscard]] std::uint32_t whole(std::size_t i) const {
    switch (field->size) {
      case 1:
        return at<std::uint8_t>(i);
      case 2:
        return at<std::uint16_t>(i);
      case 4:
        return at<std::uint32_t>(i);
      default:
        return static_cast<std::uint32_t>(at<std::uint64_t>(i));
    }
  }
};

/// The points in memory: one after the other, or (compressed files) field by field.
struct Points {
  std::string_view in_file;  ///< or, where the file does not hold them as they are,
  std::string unpacked;
  bool by_field = false;

  [[nodiscard]] Column column(const PcdHeader& header, const PcdField& field) const {
    const char* bytes = in_file.data() ? in_file.data() : unpacked.data();
    if (by_field) return {&field, bytes + field.offset * header.points(), field.size * field.count};
    return {&field, bytes + field.offset, header.point_bytes};
  }
};

template <class T>
bool put_number(std::string_view word, char* to) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  // Too large or too small to be told apart from infinity or 0.
  if (error != std::errc() && !(std::is_floating_point_v<T> && error == std::errc::result_out_of_range))
    return false;
  std::memcpy(to, &value, sizeof value);
  return true;
}

template <class Signed, class Unsigned>
bool put_whole(char type, std::string_view word, char* to) {
  return type == 'I' ? put_number<Signed>(word, to) : put_number<Unsigned>(word, to);
}

/// Text to the bytes that a binary file would hold.
bool put_element(const PcdField& field, std::string_view word, char* to) {
  if (field.type == 'F') return field.size == 8 ? put_number<double>(word, to) : put_number<float>(word, to);
  switch (field.size) {
    case 1:
      return put_whole<std::int8_t, std::uint8_t>(field.type, word, to);
    case 2:
      return put_whole<std::int16_t, std::uint16_t>(field.type, word, to);
    case 4:
      return put_whole<std::int32_t, std::uint32_t>(field.type, word, to);
    default:
      return put_whole<std::int64_t, std::uint64_t>(field.type, word, to);
  }
}

Points from_text(const PcdHeader& header, std::string_view text) {
  // A digit and a separator each: enough to refuse sizes that lie before there is memory for them.
  const std::size_t least = 2 * header.points() * header.point_elements;
  if (text.size() + 1 < least) fail_short(text.size(), least);
  Points points;
  points.unpacked.resize(header.points() * header.point_bytes);
  char* to = points.unpacked.data();
  for (std::size_t i = 0; i < header.points(); ++i) {
    for (const PcdField& field : header.fields) {
      for (std::size_t k = 0; k < field.count; ++k, to += field.size) {
        const std::string_view word = next_word(text);
        if (word.empty())
          fail("ends too early: " + std::to_string(i) + " points, expected " +
               std::to_string(header.points()));
        if (!put_element(field, word, to))
          fail("point " + std::to_string(i) + " has no number in field " + field.name);
      }
    }
  }
  return points;
}

Points from_compressed(const PcdHeader& header, std::string_view data) {
  const std::size_t expected = header.points() * header.point_bytes;
  Points points;
  points.by_field = true;
  if (expected == 0) return points;
  std::array<std::uint32_t, 2> sizes{};
  if (data.size() < sizeof sizes) fail_short(data.size(), sizeof sizes);
  std::memcpy(sizes.data(), data.data(), sizeof sizes);
  data.remove_prefix(sizeof sizes);
  if (sizes[1] != expected) {
    fail("damaged: its points unpack to " + std::to_string(sizes[1]) + " bytes, expected " +
         std::to_string(expected));
  }
  if (sizes[0] > data.size()) fail_short(data.size(), sizes[0]);
  // LZF packs 264 bytes into 3 at best.
  if (expected / 88 > std::size_t{sizes[0]} + 1)
    fail("damaged: so few bytes cannot unpack to " + std::to_string(expected));
  points.unpacked.resize(expected);
  if (!lzf_unpack(data.substr(0, sizes[0]), points.unpacked)) fail("damaged: its points cannot be unpacked");
  return points;
}

void check_limits(const PcdHeader& header, const CloudFileLimits& limits) {
  if (header.points() > limits.max_points) {
    fail("has " + std::to_string(header.points()) + " points, expected at most " +
         std::to_string(limits.max_points));
  }
  const std::size_t bytes = header.data == PcdData::kBinary ? 0 : header.points() * header.point_bytes;
  if (bytes > limits.max_unpacked_bytes) {
    fail("unpacks to " + std::to_string(bytes) + " bytes, expected at most " +
         std::to_string(limits.max_unpacked_bytes));
  }
}

Points read_points(const PcdHeader& header, std::string_view data) {
  if (header.data == PcdData::kAscii) return from_text(header, data);
  if (header.data == PcdData::kCompressed) return from_compressed(header, data);
  const std::size_t expected = header.points() * header.point_bytes;
  if (data.size() < expected) fail_short(data.size(), expected);
  Points points;
  points.in_file = data;
  return points;
}

RawVector<float> coordinates(const PcdHeader& header, const Points& points, const char* name) {
  const PcdField* field = header.find(name);
  if (!field) fail(std::string("has no field ") + name);
  if (field->type != 'F') fail(std::string("its field ") + name + " is not of a floating-point type");
  const Column column = points.column(header, *field);
  RawVector<float> values(header.points());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = column.real(i);
  return values;
}

std::vector<std::uint32_t> whole_numbers(const PcdHeader& header, const Points& points, const PcdField* field,
                                         std::uint32_t mask) {
  if (!field) return {};
  const Column column = points.column(header, *field);
  std::vector<std::uint32_t> values(header.points());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = column.whole(i) & mask;
  return values;
}

}  // namespace

bool lzf_unpack(std::string_view in, std::string& out) {
  std::size_t from = 0, to = 0;
  while (from < in.size()) {
    const auto control = static_cast<unsigned char>(in[from++]);
    if (control < 32) {  // A run as it is.
      const std::size_t length = control + 1u;
      if (length > in.size() - from || length > out.size() - to) return false;
      std::memcpy(out.data() + to, in.data() + from, length);
      from += length;
      to += length;
      continue;
    }
    // A piece of what is there already; it may overlap what it makes.
    std::size_t length = control >> 5;
    if (length == 7) {
      if (from == in.size()) return false;
      length += static_cast<unsigned char>(in[from++]);
    }
    length += 2;
    if (from == in.size()) return false;
    const std::size_t back = ((control & 31u) << 8) + static_cast<unsigned char>(in[from++]) + 1;
    if (back > to || length > out.size() - to) return false;
    for (std::size_t i = 0; i < length; ++i, ++to) out[to] = out[to - back];
  }
  return to == out.size();
}

LabelledCloud parse_pcd(std::string_view file, const CloudFileLimits& limits) {
  const PcdHeader header = parse_pcd_header(file);
  check_limits(header, limits);
  const Points points = read_points(header, file.substr(header.data_start));
  LabelledCloud result;
  result.cloud.x = coordinates(header, points, "x");
  result.cloud.y = coordinates(header, points, "y");
  result.cloud.z = coordinates(header, points, "z");
  result.cloud.width = static_cast<int>(header.width);
  result.cloud.height = static_cast<int>(header.height);
  result.cloud.viewpoint = header.viewpoint;
  const PcdField* color = header.find("rgba");
  if (!color) color = header.find("rgb");
  // Colours are packed, also where their type is a float.
  if (color && color->size == 4) result.rgb = whole_numbers(header, points, color, 0xffffff);
  const PcdField* label = header.find("label");
  if (label && label->type != 'F') result.label = whole_numbers(header, points, label, 0xffffffff);
  return result;
}

}  // namespace graspd
