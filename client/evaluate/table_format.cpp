// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "client/common/handle_csv.hpp"
#include "client/common/json_writer.hpp"
#include "client/common/text.hpp"
#include "client/evaluate/tables.hpp"

namespace graspd {
namespace {

std::string json_key(const std::string& column) {
  std::string key;
  for (const char c : column) key += c == ' ' || c == '/' || c == '@' ? '_' : c;
  return key;
}

/// A cell for people.
struct ForReading {
  std::string operator()(std::monostate /*nothing*/) const { return "-"; }
  std::string operator()(const std::string& text) const {
    std::string escaped;
    for (const char c : plain_line(text)) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    return escaped;
  }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    return printed(std::abs(value) < 1000 ? "%.3g" : "%.0f", value);
  }
  std::string operator()(Percentage share) const {
    return share.value ? printed("%.1f %%", 100 * *share.value) : "-";
  }
};

/// A cell for spreadsheets: shares stay fractions.
struct ForCsv {
  std::string operator()(std::monostate /*nothing*/) const { return {}; }
  std::string operator()(const std::string& text) const { return csv_cell(text); }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return std::isfinite(value) ? printed("%.9g", value) : ""; }
  std::string operator()(Percentage share) const { return share.value ? (*this)(*share.value) : ""; }
};

struct ForJson {
  JsonWriter& json;

  void operator()(std::monostate /*nothing*/) const { json.value(std::nan("")); }
  void operator()(const std::string& text) const { json.value(std::string_view(text)); }
  void operator()(std::int64_t value) const { json.value(value); }
  void operator()(double value) const { json.value_float(value); }
  void operator()(Percentage share) const { json.value_float(share.value.value_or(std::nan(""))); }
};

std::string markdown(const Table& table) {
  std::string text = "## " + table.title + "\n\n|";
  const auto add = [&text](const std::string& cell) { text.append(" ").append(cell).append(" |"); };
  for (const std::string& column : table.columns) add(ForReading()(column));
  text += "\n|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) text += c == 0 ? "---|" : "---:|";
  text += '\n';
  for (const auto& row : table.rows) {
    text += '|';
    for (const Cell& cell : row) add(std::visit(ForReading(), cell));
    text += '\n';
  }
  return text;
}

std::string csv(const Table& table) {
  std::string text = "table";
  for (const std::string& column : table.columns) text.append(",").append(csv_cell(json_key(column)));
  text += '\n';
  for (const auto& row : table.rows) {
    text += table.name;
    for (const Cell& cell : row) text.append(",").append(std::visit(ForCsv(), cell));
    text += '\n';
  }
  return text;
}

void json(const Table& table, JsonWriter& out) {
  out.key(table.name).begin_array();
  for (const auto& row : table.rows) {
    out.begin_object();
    for (std::size_t c = 0; c < row.size(); ++c) {
      out.key(json_key(table.columns[c]));
      std::visit(ForJson{out}, row[c]);
    }
    out.end_object();
  }
  out.end_array();
}

std::string blocks(std::span<const Table> tables, std::string (*write)(const Table&)) {
  std::string text;
  for (const Table& table : tables) text.append(text.empty() ? "" : "\n").append(write(table));
  return text;
}

}  // namespace

std::string write_tables(std::span<const Table> tables, TableFormat format) {
  if (format == TableFormat::kMarkdown) return blocks(tables, markdown);
  if (format == TableFormat::kCsv) return blocks(tables, csv);
  JsonWriter out;
  out.begin_object();
  for (const Table& table : tables) json(table, out);
  out.end_object();
  return out.str() + '\n';
}

}  // namespace graspd
