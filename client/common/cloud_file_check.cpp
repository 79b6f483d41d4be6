// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_file_check.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "client/common/cloud_file.hpp"

namespace graspd {
namespace {

constexpr std::uint64_t kMaxPoints = 100'000'000;
constexpr std::uint64_t kMaxPointBytes = 65'536;
constexpr int kMaxHeaderLines = 1000;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw CloudFileError(path.string() + ": " + reason);
}

std::ifstream open(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) fail(path, "no such file");
  if (error) fail(path, error.message());
  if (std::filesystem::is_directory(status)) fail(path, "is a folder, expected a PCD or PLY file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, std::string("cannot be opened: ") + std::strerror(errno));
  return file;
}

/// The words of a header line, first the key; false at the end of the file.
bool next_line(std::ifstream& file, std::vector<std::string>& words) {
  std::string line;
  if (!std::getline(file, line)) return false;
  words.clear();
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return true;
}

std::optional<std::uint64_t> number(const std::string& word) {
  if (word.empty() || word.size() > 18 || word.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::stoull(word);
}

using PcdHeader = std::map<std::string, std::vector<std::string>>;

/// Reads up to and with the DATA line.
PcdHeader read_pcd_header(std::ifstream& file, const std::filesystem::path& path) {
  PcdHeader header;
  std::vector<std::string> words;
  for (int line = 0; line < kMaxHeaderLines && next_line(file, words); ++line) {
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string key = words[0];
    header[key] = {words.begin() + 1, words.end()};
    if (key == "DATA") return header;
  }
  fail(path, "the PCD header has no DATA line");
}

std::uint64_t header_number(const PcdHeader& header, const std::string& key,
                            const std::filesystem::path& path) {
  const auto entry = header.find(key);
  if (entry == header.end() || entry->second.empty()) fail(path, "the PCD header has no " + key);
  const auto value = number(entry->second[0]);
  if (!value) fail(path, "the PCD header's " + key + " is '" + entry->second[0] + "', expected a count");
  return *value;
}

/// Bytes a point takes in binary data.
std::uint64_t pcd_point_bytes(const PcdHeader& header, const std::filesystem::path& path) {
  const auto fields = header.find("FIELDS");
  const auto sizes = header.find("SIZE");
  const auto types = header.find("TYPE");
  if (fields == header.end() || sizes == header.end() || types == header.end()) {
    fail(path, "the PCD header has no FIELDS, SIZE or TYPE");
  }
  const auto counts = header.find("COUNT");
  const std::size_t n = fields->second.size();
  const bool same = sizes->second.size() == n && types->second.size() == n &&
                    (counts == header.end() || counts->second.size() == n);
  if (n == 0 || !same) fail(path, "the PCD header's FIELDS, SIZE, TYPE and COUNT differ in length");
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto size = number(sizes->second[i]);
    const auto count = counts == header.end() ? std::optional<std::uint64_t>(1) : number(counts->second[i]);
    if (!size || !count || (*size != 1 && *size != 2 && *size != 4 && *size != 8) || *count == 0 ||
        *count > kMaxPointBytes) {
      fail(path, "the PCD header gives the field " + fields->second[i] + " an impossible size");
    }
    bytes += *size * *count;
  }
  if (bytes > kMaxPointBytes) fail(path, "the PCD header's points are larger than any known");
  return bytes;
}

void check_compressed(std::ifstream& file, const std::filesystem::path& path, std::uint64_t expected,
                      std::uint64_t left) {
  std::array<unsigned char, 8> sizes{};
  if (!file.read(reinterpret_cast<char*>(sizes.data()), sizes.size())) fail(path, "ends before its points");
  const auto u32 = [&](std::size_t at) {
    return std::uint64_t{sizes[at]} | std::uint64_t{sizes[at + 1]} << 8 | std::uint64_t{sizes[at + 2]} << 16 |
           std::uint64_t{sizes[at + 3]} << 24;
  };
  if (u32(4) != expected) {
    fail(path, "damaged: its points unpack to " + std::to_string(u32(4)) + " bytes, expected " +
                   std::to_string(expected));
  }
  if (u32(0) + 8 > left) {
    fail(path, "ends too early: " + std::to_string(left) + " bytes of points, expected " +
                   std::to_string(u32(0) + 8));
  }
}

std::uint64_t bytes_left(std::ifstream& file, const std::filesystem::path& path) {
  const auto here = static_cast<std::uint64_t>(file.tellg());
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail(path, error.message());
  return size > here ? size - here : 0;
}

}  // namespace

CloudFormat sniff_format(const std::filesystem::path& path) {
  std::ifstream file = open(path);
  std::array<char, 512> start{};
  file.read(start.data(), start.size());
  const std::string_view text(start.data(), static_cast<std::size_t>(file.gcount()));
  if (text.empty()) fail(path, "is empty");
  if (text.starts_with("ply\n") || text.starts_with("ply\r\n")) return CloudFormat::kPly;
  for (const std::string_view key : {"# .PCD", "#.PCD", "VERSION ", "FIELDS "}) {
    if (text.starts_with(key)) return CloudFormat::kPcd;
  }
  // Comments of any kind may come first.
  if (text.find("\nVERSION ") != text.npos || text.find("\nFIELDS ") != text.npos) return CloudFormat::kPcd;
  fail(path, "is neither a PCD nor a PLY file");
}

void check_pcd(const std::filesystem::path& path) {
  std::ifstream file = open(path);
  const PcdHeader header = read_pcd_header(file, path);
  const std::uint64_t width = header_number(header, "WIDTH", path);
  const std::uint64_t height = header_number(header, "HEIGHT", path);
  const std::uint64_t points =
      header.contains("POINTS") ? header_number(header, "POINTS", path) : width * height;
  if (width > kMaxPoints || height > kMaxPoints || points > kMaxPoints)
    fail(path, "the PCD header promises too many points");
  if (points != width * height) {
    fail(path, "the PCD header's POINTS " + std::to_string(points) + " is not WIDTH " +
                   std::to_string(width) + " x HEIGHT " + std::to_string(height));
  }
  const std::uint64_t expected = points * pcd_point_bytes(header, path);
  const std::uint64_t left = bytes_left(file, path);
  const auto& data = header.at("DATA");
  const std::string kind = data.empty() ? "" : data[0];
  if (kind == "binary_compressed") {
    if (points > 0) check_compressed(file, path, expected, left);
  } else if (kind == "binary" || kind == "ascii") {
    // The shortest text of a point is a digit and a separator for each field.
    const std::uint64_t least = kind == "binary" ? expected : 2 * points * header.at("FIELDS").size();
    if (left + 1 < least || (kind == "binary" && left < least)) {
      fail(path,
           "ends too early: " + std::to_string(left) + " bytes of points, expected " + std::to_string(least));
    }
  } else {
    fail(path, "the PCD header's DATA is '" + kind + "', expected ascii, binary or binary_compressed");
  }
}

void check_ply(const std::filesystem::path& path) {
  std::ifstream file = open(path);
  std::vector<std::string> words;
  std::optional<std::uint64_t> vertices;
  std::string format;
  for (int line = 0; line < kMaxHeaderLines && next_line(file, words); ++line) {
    if (words.empty()) continue;
    if (words[0] == "format" && words.size() > 1) format = words[1];
    if (words[0] == "element" && words.size() == 3) {
      const auto count = number(words[2]);
      if (!count || *count > kMaxPoints)
        fail(path, "the PLY header promises '" + words[2] + "' of " + words[1]);
      if (words[1] == "vertex") vertices = count;
    }
    if (words[0] != "end_header") continue;
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
      fail(path, "the PLY header's format is '" + format + "'");
    }
    if (!vertices) fail(path, "the PLY header has no element vertex");
    // Three coordinates of a digit and a separator in text, of a byte in binary.
    const std::uint64_t least = *vertices * (format == "ascii" ? 6 : 3);
    if (bytes_left(file, path) + 1 < least)
      fail(path, "ends too early for its " + std::to_string(*vertices) + " points");
    return;
  }
  fail(path, "the PLY header has no end_header line");
}

}  // namespace graspd
