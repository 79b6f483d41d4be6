// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The settings of the whole method, one struct a stage.
#pragma once

#include "service/pipeline/container.hpp"
#include "service/pipeline/downsample.hpp"
#include "service/pipeline/edge_points.hpp"
#include "service/pipeline/handle_check.hpp"
#include "service/pipeline/handle_ranking.hpp"
#include "service/pipeline/handle_search.hpp"
#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/objects.hpp"
#include "service/pipeline/segments.hpp"
#include "service/pipeline/smoothing.hpp"
#include "service/pipeline/support.hpp"
#include "service/pipeline/workspace_filter.hpp"

namespace graspd {

struct DetectConfig {
  WorkspaceFilterConfig workspace;
  SmoothingConfig smoothing;
  DownsampleConfig downsample;
  NeighborhoodsConfig neighborhoods;
  SmoothnessConfig smoothness;
  SupportConfig support;
  SegmentsConfig segments;
  ContainerConfig container;
  ObjectsConfig objects;
  HandleSearchConfig search;
  HandleCheckConfig check;
  HandleRankingConfig ranking;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("workspace", self.workspace, "which points are looked at");
    v("smoothing", self.smoothing, "for noisy sensors");
    v("downsample", self.downsample, "one point a voxel");
    v("neighborhoods", self.neighborhoods, "what counts as near");
    v("smoothness", self.smoothness, "edge points and region growing under two thresholds");
    v("support", self.support, "the plane that objects stand on");
    v("segments", self.segments, "which surfaces are looked at");
    v("container", self.container, "the bin that objects lie in");
    v("objects", self.objects, "which segments belong together");
    v("search", self.search, "candidates");
    v("check", self.check, "what a candidate must fulfil");
    v("ranking", self.ranking, "which handles are published, in which order");
  }

  /// Neighbourhoods must reach the next voxels, and not thousands of them.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

}  // namespace graspd
