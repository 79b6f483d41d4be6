// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/handle_file.hpp"

#include <charconv>
#include <cmath>

#include "client/common/read_file.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

std::string read_text(const std::filesystem::path& path) {
  try {
    return read_file(path);
  } catch (const std::runtime_error& error) {
    throw CsvError(error.what());
  }
}

/// Takes the next record off the text; lines counts its line ends. False where a quote is never closed.
bool take_record(std::string_view& text, std::vector<std::string>& cells, std::size_t& lines) {
  cells.assign(1, {});
  bool quoted = false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++lines;
    if (quoted) {
      if (c != '"') {
        cells.back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cells.back() += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  text.remove_prefix(std::min(i + 1, text.size()));
  return !quoted;
}

template <class T>
bool parse(const std::string& cell, T& value) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

Handle handle_of(const CsvFile& file, std::size_t row) {
  Handle handle;
  handle.position = {file.number(row, "px"), file.number(row, "py"), file.number(row, "pz")};
  const Eigen::Quaternionf q(file.number(row, "qw"), file.number(row, "qx"), file.number(row, "qy"),
                             file.number(row, "qz"));
  if (!(q.norm() > 1e-3f)) file.fail(row, "qw, qx, qy, qz are no rotation");
  handle.rotation = q.normalized().toRotationMatrix();
  handle.width_m = file.number(row, "width");
  if (file.has("score")) handle.score = file.number(row, "score");
  return handle;
}

template <class Key>
const std::pmr::vector<Handle>* found(const std::map<Key, std::pmr::vector<Handle>>& handles,
                                      const Key& key) {
  const auto at = handles.find(key);
  return at == handles.end() ? nullptr : &at->second;
}

}  // namespace

CsvFile::CsvFile(std::filesystem::path path, const std::vector<std::string>& needed)
    : path_(std::move(path)) {
  const std::string bytes = read_text(path_);
  std::string_view text = bytes;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::string> cells;
  std::size_t line = 1, next = 1;
  if (!take_record(text, cells, next)) throw CsvError(path_.string() + ":1: a quote is never closed");
  for (std::size_t i = 0; i < cells.size(); ++i) columns_.try_emplace(cells[i], i);
  for (const std::string& column : needed)
    if (!has(column)) throw CsvError(path_.string() + ":1: has no column `" + column + "`");
  const std::size_t width = cells.size();
  while (!text.empty()) {
    line = next;
    const bool closed = take_record(text, cells, next);
    const std::string place = path_.string() + ":" + std::to_string(line);
    if (!closed) throw CsvError(place + ": a quote is never closed");
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (cells.size() != width)
      throw CsvError(place + printed(": has %zu cells, expected %zu", cells.size(), width));
    rows_.push_back(cells);
    lines_.push_back(line);
  }
}

void CsvFile::fail(std::size_t row, const std::string& reason) const {
  throw CsvError(path_.string() + ":" + std::to_string(lines_[row]) + ": " + plain_line(reason));
}

const std::string& CsvFile::text(std::size_t row, const std::string& column) const {
  return rows_[row][columns_.at(column)];
}

float CsvFile::number(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  float value = 0;
  if (!parse(cell, value) || !std::isfinite(value))
    fail(row, column + " is no finite number (got '" + cell + "')");
  return value;
}

std::int64_t CsvFile::integer(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  std::int64_t value = 0;
  if (!parse(cell, value)) fail(row, column + " is no integer (got '" + cell + "')");
  return value;
}

const std::pmr::vector<Handle>* HandleFile::find(const std::string& frame) const {
  return found(by_frame, frame);
}

const std::pmr::vector<Handle>* HandleFile::find(std::int64_t seq) const {
  return found(by_seq, seq);
}

HandleFile read_handle_file(const std::filesystem::path& path) {
  const CsvFile file(path, {"frame", "px", "py", "pz", "qw", "qx", "qy", "qz", "width"});
  HandleFile result;
  for (std::size_t row = 0; row < file.size(); ++row) {
    auto& of_frame = result.by_frame[file.text(row, "frame")];
    auto* of_seq = file.has("seq") ? &result.by_seq[file.integer(row, "seq")] : nullptr;
    if (file.has("id") && file.text(row, "id") == "-1") continue;
    const Handle handle = handle_of(file, row);
    of_frame.push_back(handle);
    if (of_seq) of_seq->push_back(handle);
  }
  return result;
}

std::map<std::string, std::set<int>> read_graspable_file(const std::filesystem::path& path, int min_poses) {
  const CsvFile file(path, {"frame", "object", "poses"});
  std::map<std::string, std::set<int>> result;
  for (std::size_t row = 0; row < file.size(); ++row) {
    std::set<int>& objects = result[file.text(row, "frame")];
    if (file.integer(row, "poses") >= min_poses)
      objects.insert(static_cast<int>(file.integer(row, "object")));
  }
  return result;
}

std::map<std::string, std::string> read_category_file(const std::filesystem::path& path) {
  const CsvFile file(path, {"frame", "category"});
  std::map<std::string, std::string> result;
  for (std::size_t row = 0; row < file.size(); ++row)
    result[file.text(row, "frame")] = file.text(row, "category");
  return result;
}

}  // namespace graspd
