// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Figures over judged frames: the paper's recall, precision, and what the order of handles is worth.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/evaluate/evaluation.hpp"

namespace graspd {

/// part / whole; nothing for 0 / 0.
[[nodiscard]] std::optional<double> share(int part, int whole);

/// Counts over frames; every share is made of two of them.
struct Figures {
  static constexpr std::array kRecallAt{1, 2, 3, 5};
  static constexpr int kBest = 5;

  int frames = 0;
  int frames_first_valid = 0;  ///< whose first handle is valid
  int objects = 0;             ///< that count for recall
  int objects_found = 0;       ///< with a valid handle at least
  /// Objects with a valid handle among the best kRecallAt[i] of those on the object.
  std::array<int, kRecallAt.size()> objects_found_at{};
  int handles = 0;
  int valid_handles = 0;
  int best_handles = 0;  ///< among the best kBest of each frame
  int valid_best_handles = 0;
  int max_handles_per_frame = 0;
  int handles_on_objects = 0;  ///< on the objects that count
  int max_handles_per_object = 0;

  /// The paper's measure: objects with at least one valid handle / objects.
  [[nodiscard]] std::optional<double> recall() const { return share(objects_found, objects); }
  /// Valid handles / all handles.
  [[nodiscard]] std::optional<double> precision() const { return share(valid_handles, handles); }
  /// Frames whose first handle is valid / frames; those without handles count as not.
  [[nodiscard]] std::optional<double> best_of_frame() const { return share(frames_first_valid, frames); }
  [[nodiscard]] std::optional<double> best_five() const { return share(valid_best_handles, best_handles); }
  [[nodiscard]] std::optional<double> recall_at(std::size_t i) const {
    return share(objects_found_at[i], objects);
  }
  [[nodiscard]] std::optional<double> handles_per_frame() const { return share(handles, frames); }
  [[nodiscard]] std::optional<double> handles_per_object() const {
    return share(handles_on_objects, objects);
  }
};

[[nodiscard]] Figures figures(std::span<const JudgedFrame> frames);
[[nodiscard]] Figures figures(const JudgedFrame& frame);

/// What became of one object in one frame.
struct ObjectOutcome {
  int object = -1;
  int handles = 0;
  int valid_handles = 0;
  int best_valid_rank = -1;  ///< in the frame, from 0; -1: none is valid

  [[nodiscard]] bool found() const { return valid_handles > 0; }
};

/// One for each object that counts, in the frame's order.
[[nodiscard]] std::vector<ObjectOutcome> object_outcomes(const JudgedFrame& frame);

/// Figures of the frames of one category.
struct CategoryFigures {
  std::string category;
  Figures figures;
};

/// In the order in which the categories first occur. Empty when no frame has one.
[[nodiscard]] std::vector<CategoryFigures> figures_by_category(std::span<const JudgedFrame> frames);

/// An object over all frames that show it (the paper's table of single objects).
struct ObjectFigures {
  std::string category;
  int object = -1;
  int frames = 0;        ///< in which it counts
  int frames_found = 0;  ///< in which it has a valid handle
  int handles = 0;
  int valid_handles = 0;
};

/// Labels mean the same object within a category. By category in the order of the frames, then by object.
[[nodiscard]] std::vector<ObjectFigures> figures_by_object(std::span<const JudgedFrame> frames);

/// How many handles failed for one reason.
struct FailureCount {
  std::string failure;
  int handles = 0;
};

/// Most frequent first, then by name.
[[nodiscard]] std::vector<FailureCount> failure_counts(std::span<const JudgedFrame> frames);

/// The handles with a score in [from, to).
struct ScoreBin {
  double from = 0;
  double to = 0;
  int handles = 0;
  int valid_handles = 0;
  double mean_score = 0;
};

struct Calibration {
  std::vector<ScoreBin> bins;  ///< over [0, 1]; the last one holds 1 as well
  /// Mean over handles of | mean score - share of valid handles | of their bins; nothing without handles.
  std::optional<double> expected_error;
};

[[nodiscard]] Calibration calibration(std::span<const JudgedFrame> frames, int num_bins = 10);

}  // namespace graspd
