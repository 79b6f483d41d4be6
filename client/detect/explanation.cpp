// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/detect/explanation.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "client/common/handle_csv.hpp"
#include "client/common/handle_text.hpp"
#include "client/common/json_writer.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

/// Handles of the list that are on a segment.
std::ptrdiff_t num_listed(const handle_list_t& list, std::size_t segment) {
  return std::count_if(list.handles.begin(), list.handles.end(), [segment](const handle_t& handle) {
    return handle.segment_id == static_cast<std::int32_t>(segment);
  });
}

/// "too_wide 12, fingers 3", in the order of the checks.
std::string counts_by_check(const FailureCounts& failures) {
  std::string text;
  for (std::size_t i = 0; i < kNumFailures; ++i)
    if (failures[i] > 0)
      text += (text.empty() ? "" : ", ") + std::string(name(static_cast<Failure>(i))) +
              printed(" %d", failures[i]);
  return text;
}

std::string why_not(const SegmentReport& segment, std::ptrdiff_t listed) {
  if (segment.num_handles > 0)
    return listed > 0 ? "" : "left out of the list: too close to others, too many, or the score too low";
  if (segment.num_candidates == 0) return "no candidate: no place on it is worth a try";
  return std::string(in_words(segment.reason())) + " (" + counts_by_check(segment.failures) + ")";
}

/// Puts a last column, set to the left, beside a table's lines.
std::string with_texts(const std::string& table, const std::vector<std::string>& texts) {
  std::istringstream lines(table);
  std::string result, line;
  for (const std::string& text : texts) {
    std::getline(lines, line);
    result += line + (text.empty() ? "" : "  " + text) + '\n';
  }
  return result;
}

FailureCounts segments_by_reason(const std::pmr::vector<SegmentReport>& segments) {
  FailureCounts counts{};
  for (const SegmentReport& segment : segments)
    if (segment.num_handles == 0) ++counts[static_cast<std::size_t>(segment.reason())];
  return counts;
}

}  // namespace

std::string_view in_words(Failure failure) {
  constexpr std::array<std::string_view, kNumFailures + 1> kWords{
      "too few points of it between the jaws",
      "wider than the aperture",
      "something else between the jaws, or no gap beside it",
      "a finger would hit something",
      "the palm would hit something",
      "the hand would hit something on its way in",
      "a fingertip or the hand would go below the support",
      "its sides run across the jaws, which would slip",
      "its sides widen towards the fingertips, the jaws would slide off",
      "a jaw would not meet a wall that it can rely on",
      "the hand would go where the sensor has not looked",
      "has handles"};
  return kWords[static_cast<std::size_t>(failure)];
}

std::string explanation_table(const FileDetection& detected) {
  if (detected.segments.empty()) return "no segments\n";
  TextTable table(
      {"segment", "x [m]", "y [m]", "z [m]", "points", "object", "candidates", "handles", "listed"});
  std::vector<std::string> texts{
      "why not: the last check that was reached (and candidates by the one they failed)"};
  for (std::size_t i = 0; i < detected.segments.size(); ++i) {
    const SegmentReport& s = detected.segments[i];
    const auto listed = num_listed(detected.list, i);
    table.add({printed("%zu", i), printed("%.3f", s.centroid.x()), printed("%.3f", s.centroid.y()),
               printed("%.3f", s.centroid.z()), printed("%d", s.num_points), printed("%d", s.object),
               printed("%d", s.num_candidates), printed("%d", s.num_handles), printed("%td", listed)});
    texts.push_back(why_not(s, listed));
  }
  const std::string without = counts_by_check(segments_by_reason(detected.segments));
  return with_texts(table.str(), texts) +
         "segments without a handle: " + (without.empty() ? "none" : without) + '\n';
}

std::string explanation_csv_header() {
  std::string text = "frame,seq,segment,object,px,py,pz,points,candidates,handles,listed,reason";
  for (std::size_t i = 0; i < kNumFailures; ++i) text += ',' + std::string(name(static_cast<Failure>(i)));
  return text + '\n';
}

std::string explanation_csv_rows(const FileDetection& detected) {
  const std::string start =
      csv_cell(detected.list.frame_name) + printed(",%lld", static_cast<long long>(detected.list.seq));
  std::string text;
  for (std::size_t i = 0; i < detected.segments.size(); ++i) {
    const SegmentReport& s = detected.segments[i];
    text += start +
            printed(",%zu,%d,%.9g,%.9g,%.9g", i, s.object, s.centroid.x(), s.centroid.y(), s.centroid.z());
    text += printed(",%d,%d,%d,%td,", s.num_points, s.num_candidates, s.num_handles,
                    num_listed(detected.list, i));
    text += name(s.reason());
    for (const int n : s.failures) text += printed(",%d", n);
    text += '\n';
  }
  return text;
}

std::string explanation_json(const FileDetection& detected) {
  JsonWriter json;
  json.begin_object();
  write_handle_list(json, detected.list);
  json.key("segments").begin_array();
  for (std::size_t i = 0; i < detected.segments.size(); ++i) {
    const SegmentReport& s = detected.segments[i];
    json.begin_object().member("id", i).member("object", s.object).key("centroid").begin_array();
    for (const float v : s.centroid) json.value_float(v);
    json.end_array().member("num_points", s.num_points).member("num_candidates", s.num_candidates);
    json.member("num_handles", s.num_handles).member("num_listed", num_listed(detected.list, i));
    json.member("reason", name(s.reason())).key("failures").begin_object();
    for (std::size_t f = 0; f < kNumFailures; ++f)
      if (s.failures[f] > 0) json.member(name(static_cast<Failure>(f)), s.failures[f]);
    json.end_object().end_object();
  }
  json.end_array().end_object();
  return json.str();
}

}  // namespace graspd
