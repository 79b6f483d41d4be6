// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace graspd {
namespace {

int count_of(auto size) {
  return static_cast<int>(size);
}

bool is_valid(const JudgedHandle& handle) {
  return handle.valid;
}

void add_objects(const JudgedFrame& frame, Figures& f) {
  for (const int object : std::set<int>(frame.objects.begin(), frame.objects.end())) {
    ++f.objects;
    int rank = 0;
    int first_valid = -1;
    for (const JudgedHandle& handle : frame.handles) {
      if (handle.object != object) continue;
      if (handle.valid && first_valid < 0) first_valid = rank;
      ++rank;
    }
    f.handles_on_objects += rank;
    f.max_handles_per_object = std::max(f.max_handles_per_object, rank);
    if (first_valid < 0) continue;
    ++f.objects_found;
    for (std::size_t i = 0; i < Figures::kRecallAt.size(); ++i)
      if (first_valid < Figures::kRecallAt[i]) ++f.objects_found_at[i];
  }
}

void add(const JudgedFrame& frame, Figures& f) {
  ++f.frames;
  if (!frame.handles.empty() && frame.handles.front().valid) ++f.frames_first_valid;
  f.handles += count_of(frame.handles.size());
  f.max_handles_per_frame = std::max(f.max_handles_per_frame, count_of(frame.handles.size()));
  f.valid_handles += count_of(std::count_if(frame.handles.begin(), frame.handles.end(), is_valid));
  const auto best = std::min<std::ptrdiff_t>(Figures::kBest, std::ssize(frame.handles));
  f.best_handles += count_of(best);
  f.valid_best_handles +=
      count_of(std::count_if(frame.handles.begin(), frame.handles.begin() + best, is_valid));
  add_objects(frame, f);
}

}  // namespace

std::optional<double> share(int part, int whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / whole;
}

Figures figures(std::span<const JudgedFrame> frames) {
  Figures f;
  for (const JudgedFrame& frame : frames) add(frame, f);
  return f;
}

Figures figures(const JudgedFrame& frame) {
  return figures(std::span(&frame, 1));
}

std::vector<ObjectOutcome> object_outcomes(const JudgedFrame& frame) {
  std::vector<ObjectOutcome> outcomes;
  for (const int object : frame.objects) {
    const auto same = [object](const ObjectOutcome& outcome) { return outcome.object == object; };
    if (std::any_of(outcomes.begin(), outcomes.end(), same)) continue;
    ObjectOutcome& outcome = outcomes.emplace_back();
    outcome.object = object;
    for (std::size_t rank = 0; rank < frame.handles.size(); ++rank) {
      const JudgedHandle& handle = frame.handles[rank];
      if (handle.object != object) continue;
      ++outcome.handles;
      if (!handle.valid) continue;
      ++outcome.valid_handles;
      if (outcome.best_valid_rank < 0) outcome.best_valid_rank = count_of(rank);
    }
  }
  return outcomes;
}

std::vector<CategoryFigures> figures_by_category(std::span<const JudgedFrame> frames) {
  std::vector<CategoryFigures> result;
  for (const JudgedFrame& frame : frames) {
    if (frame.category.empty()) continue;
    auto found = std::find_if(result.begin(), result.end(),
                              [&](const CategoryFigures& c) { return c.category == frame.category; });
    if (found == result.end()) found = result.insert(result.end(), {frame.category, {}});
    add(frame, found->figures);
  }
  return result;
}

std::vector<ObjectFigures> figures_by_object(std::span<const JudgedFrame> frames) {
  std::map<std::string, std::size_t> order;  // of the categories
  std::map<std::pair<std::size_t, int>, ObjectFigures> by_object;
  for (const JudgedFrame& frame : frames) {
    const std::size_t category = order.try_emplace(frame.category, order.size()).first->second;
    for (const ObjectOutcome& outcome : object_outcomes(frame)) {
      ObjectFigures& f = by_object[{category, outcome.object}];
      f.category = frame.category;
      f.object = outcome.object;
      ++f.frames;
      f.frames_found += outcome.found() ? 1 : 0;
      f.handles += outcome.handles;
      f.valid_handles += outcome.valid_handles;
    }
  }
  std::vector<ObjectFigures> result;
  result.reserve(by_object.size());
  for (const auto& [key, f] : by_object) result.push_back(f);
  return result;
}

std::vector<FailureCount> failure_counts(std::span<const JudgedFrame> frames) {
  std::map<std::string, int> counts;
  for (const JudgedFrame& frame : frames)
    for (const JudgedHandle& handle : frame.handles)
      if (!handle.valid) ++counts[handle.failure];
  std::vector<FailureCount> result;
  result.reserve(counts.size());
  for (const auto& [failure, handles] : counts) result.push_back({failure, handles});
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.handles > b.handles; });
  return result;
}

Calibration calibration(std::span<const JudgedFrame> frames, int num_bins) {
  Calibration result;
  for (int i = 0; i < num_bins; ++i)
    result.bins.push_back({double(i) / num_bins, double(i + 1) / num_bins, 0, 0, 0});
  int handles = 0;
  for (const JudgedFrame& frame : frames) {
    for (const JudgedHandle& judged : frame.handles) {
      const double score = std::isfinite(judged.handle.score) ? double{judged.handle.score} : 0.0;
      const int bin = std::clamp(static_cast<int>(std::clamp(score, 0.0, 1.0) * num_bins), 0, num_bins - 1);
      ScoreBin& b = result.bins[static_cast<std::size_t>(bin)];
      b.mean_score += score;
      ++b.handles;
      b.valid_handles += judged.valid ? 1 : 0;
      ++handles;
    }
  }
  double error = 0;
  for (ScoreBin& b : result.bins) {
    if (b.handles == 0) continue;
    error += std::abs(b.mean_score - b.valid_handles);
    b.mean_score /= b.handles;
  }
  if (handles > 0) result.expected_error = error / handles;
  return result;
}

}  // namespace graspd
