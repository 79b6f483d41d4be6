// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/field_reader.hpp"

#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

namespace graspd {
namespace {

/// Shortest text of a number, as people write it.
std::string text_of(double number) {
  std::ostringstream out;
  out.precision(9);
  out << number;
  return out.str();
}

std::string text_of(const Range& range) {
  const bool from = std::isfinite(range.min);
  const bool to = std::isfinite(range.max);
  if (from && to) return text_of(range.min) + " to " + text_of(range.max);
  if (from) return "at least " + text_of(range.min);
  if (to) return "at most " + text_of(range.max);
  return "a number";
}

/// Quoted scalars are text, whatever they look like.
bool is_plain_scalar(const YAML::Node& node) {
  return node.IsScalar() && node.Tag() != "!";
}

template <class T>
bool parse_whole(const std::string& text, T& value) {
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(begin, end, value);
  return error == std::errc() && at == end;
}

void check_range(const YAML::Node& node, const ConfigPlace& place, const Range& range, double number) {
  // Written so that NaN fails.
  if (!(number >= range.min && number <= range.max) || !std::isfinite(number))
    place.fail("out of range", describe(node), text_of(range));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

[[noreturn]] void fail_unknown_key(const std::string& key, const ConfigPlace& place,
                                   const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(key, a) < edit_distance(key, b);
  });
  const std::size_t near_enough = std::max<std::size_t>(2, key.size() / 3);
  if (nearest != known.end() && edit_distance(key, *nearest) <= near_enough)
    place.child(key).fail("unknown key, did you mean " + *nearest + "?", key, *nearest);
  place.child(key).fail("unknown key", key, "one of " + joined(known));
}

/// The node at a path like `sources[1].channel`; invalid (false) when there is none.
YAML::Node find_path(const YAML::Node& root, std::string_view path) {
  YAML::Node node = root;
  while (!path.empty() && node) {
    const std::size_t end = std::min(path.find_first_of(".[", 1), path.size());
    std::size_t index = 0;
    if (path.front() == '[') {
      std::from_chars(path.data() + 1, path.data() + end, index);
      node.reset(node.IsSequence() && index < node.size() ? node[index]
                                                          : YAML::Node(YAML::NodeType::Undefined));
    } else {
      node.reset(find(
          node, std::string(path.substr(path.front() == '.' ? 1 : 0, end - (path.front() == '.' ? 1 : 0)))));
    }
    path.remove_prefix(end);
  }
  return node;
}

/// One line, whatever the file holds.
std::string printable(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  std::string line = text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return line;
}

}  // namespace

std::string describe(const YAML::Node& node) {
  if (!node || node.IsNull()) return "nothing";
  if (node.IsMap()) return "a map";
  if (node.IsSequence()) return "a list of " + std::to_string(node.size());
  const std::string text = printable(node.Scalar());
  return is_plain_scalar(node) ? text : '"' + text + '"';
}

YAML::Node find(const YAML::Node& map, const std::string& key) {
  if (map && map.IsMap()) {
    for (const auto& entry : map) {
      if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
    }
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

void check_map(const YAML::Node& map, const ConfigPlace& place, const std::vector<std::string>& known,
               std::span<const std::string> required) {
  const bool absent = !map || map.IsNull();
  if (!absent && !map.IsMap()) place.fail("wrong type", describe(map), "a map of keys and values");
  std::vector<std::string> seen;
  if (!absent) {
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) place.fail("wrong type of key", describe(entry.first), "a word");
      const std::string key = printable(entry.first.Scalar());
      if (std::find(known.begin(), known.end(), key) == known.end()) fail_unknown_key(key, place, known);
      if (std::find(seen.begin(), seen.end(), key) != seen.end())
        place.child(key).fail("given twice", "", "");
      seen.push_back(key);
    }
  }
  for (const std::string& key : required) {
    if (std::find(seen.begin(), seen.end(), key) == seen.end())
      place.child(key).fail("missing", "nothing", "a value");
  }
}

void fail_validation(const ConfigProblem& problem, const YAML::Node& map, const ConfigPlace& place) {
  constexpr std::string_view kExpected = ": expected ";
  const std::size_t at = problem.reason.find(kExpected);
  const std::string expected = at == std::string::npos ? "" : problem.reason.substr(at + kExpected.size());
  const YAML::Node node = find_path(map, problem.key);
  place.child(problem.key).fail(problem.reason.substr(0, at), node ? describe(node) : "", expected);
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range&, bool& value) {
  if (is_plain_scalar(node) && (node.Scalar() == "true" || node.Scalar() == "false")) {
    value = node.Scalar() == "true";
    return;
  }
  place.fail("wrong type", describe(node), "true or false");
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, double& value) {
  double number = 0;
  if (!is_plain_scalar(node) || !parse_whole(node.Scalar(), number))
    place.fail("wrong type", describe(node),
               text_of(range) == "a number" ? "a number" : "a number, " + text_of(range));
  check_range(node, place, range, number);
  value = number;
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, float& value) {
  // The range holds for the number as written (0.1f is more than 0.1), the value is the float nearest to
  // that.
  constexpr double kLargest = std::numeric_limits<float>::max();
  double number = 0;
  read_value(node, place, Range{std::max(range.min, -kLargest), std::min(range.max, kLargest)}, number);
  if (!parse_whole(node.Scalar(), value)) value = 0;  // too small for a float
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, std::int64_t& value) {
  std::int64_t number = 0;
  if (!is_plain_scalar(node) || !parse_whole(node.Scalar(), number))
    place.fail("wrong type", describe(node), "a whole number, " + text_of(range));
  check_range(node, place, range, static_cast<double>(number));
  value = number;
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, int& value) {
  const Range narrowed{std::max(range.min, static_cast<double>(std::numeric_limits<int>::min())),
                       std::min(range.max, static_cast<double>(std::numeric_limits<int>::max()))};
  std::int64_t number = 0;
  read_value(node, place, narrowed, number);
  value = static_cast<int>(number);
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range&, std::string& value) {
  if (!node.IsScalar()) place.fail("wrong type", describe(node), "a text");
  value = node.Scalar();
}

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range,
                Eigen::Vector3f& value) {
  if (!node.IsSequence() || node.size() != 3) place.fail("wrong type", describe(node), "a list of 3 numbers");
  for (int i = 0; i < 3; ++i) read_value(node[i], place.item(static_cast<std::size_t>(i)), range, value[i]);
}

std::size_t read_choice(const YAML::Node& node, const ConfigPlace& place,
                        std::span<const std::string_view> names) {
  if (node.IsScalar()) {
    const auto found = std::find(names.begin(), names.end(), node.Scalar());
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  std::string expected;
  for (const std::string_view name : names) expected += (expected.empty() ? "" : " or ") + std::string(name);
  place.fail("unknown value", describe(node), expected);
}

std::size_t list_length(const YAML::Node& node, const ConfigPlace& place) {
  if (!node.IsSequence()) place.fail("wrong type", describe(node), "a list");
  return node.size();
}

}  // namespace graspd
