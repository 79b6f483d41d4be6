// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The search for handles on the objects of one guess at what belongs together.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/handle_ranking.hpp"
#include "service/pipeline/handle_search.hpp"
#include "service/pipeline/object_outline.hpp"
#include "service/pipeline/scene_view.hpp"
#include "service/pipeline/segment_report.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

/// The cloud in all resolutions. References must outlive it.
struct CheckedScene {
  const PointCloud& cloud;
  const DepthMap& depth_map;  ///< of the cloud
  const Surfaces& surfaces;
  const FarSides& far_sides;
};

/// At what belongs together.
struct Guess {
  const Objects& objects;
  ObjectPoints points;
};

/// A handle whose steadiness has not been looked at: its score is an upper bound.
struct FoundHandle {
  RankedHandle ranked;
  HandleMargins margins;    ///< that the score was made of
  const SceneView* scene;   ///< that it was found in
  const SceneView* sparse;  ///< the same, sparse
  const Guess* guess;       ///< the same
  Candidate candidate;      ///< that it was found from; its object is the guess's

  /// Its place, to be checked again.
  [[nodiscard]] Candidate as_candidate() const {
    Candidate there = candidate;
    there.position = ranked.handle.position;
    there.rotation = ranked.handle.rotation;
    return there;
  }
};

/// What was found, and what became of the rest.
struct SearchResult {
  std::pmr::vector<FoundHandle> handles;  ///< in the order of the candidates within each round
  std::pmr::vector<SegmentReport> segments;
  FailureCounts failures{};  ///< of all candidates tried
  int num_tried = 0;

  /// Counts a candidate on a segment.
  void count(std::int32_t segment, Failure failure);
};

/// How near the jaws of a handle are to the middle of the visible object, in [0, 1]: off the middle its
/// weight turns it about the closing axis. What counts is the lever across that axis and the support's
/// normal, along the major axis where no support is known. The first 3 cm do not count, since the middle of
/// what is seen is not that of the whole; the margin falls off over the next 4.
[[nodiscard]] float centrality(const Handle& handle, const Eigen::Vector3f& object_center,
                               const std::optional<Support>& support);

/// Sets what depends on where the middle of the visible object is: its margin, and the score.
void rate(FoundHandle& found, const Eigen::Vector3f& object_center);

class GuessSearch {
 public:
  /// All must outlive the search and what it finds.
  GuessSearch(const CheckedScene& scene, const Objects& objects, const Gripper& gripper,
              const DetectConfig& config);

  /// wanted: 1 for each segment to search. Adds to out, which has a report for each segment.
  void run(const std::pmr::vector<std::uint8_t>& wanted, CheckBuffersOfThreads& buffers,
           SearchResult& out) const;

 private:
  Guess guess_;
  std::pmr::vector<std::uint32_t> level_of_object_;
  const Gripper& gripper_;
  const DetectConfig& config_;
  ObjectOutlines outlines_;
  HandleCheckConfig coarse_check_;
  SearchInput input_;
  SceneView sparse_, points_;
};

}  // namespace graspd
