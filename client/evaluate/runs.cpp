// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/runs.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "client/common/text.hpp"

namespace graspd {
namespace {

std::vector<std::size_t> kept_points(const PointCloud& cloud, bool half) {
  std::vector<std::size_t> kept;
  const auto width = static_cast<std::size_t>(std::max(cloud.width, 1));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool keep = !half || (cloud.height > 1 ? (i / width) % 2 == 0 && (i % width) % 2 == 0 : i % 4 == 0);
    if (keep) kept.push_back(i);
  }
  return kept;
}

void add_thresholds(const DetectionRun& base, std::vector<DetectionRun>& runs) {
  const SmoothnessConfig both = base.detect.smoothness;
  const float middle = 0.5f * (both.theta_low_deg + both.theta_high_deg);
  for (const float theta : {both.theta_low_deg, middle, both.theta_high_deg}) {
    DetectionRun run = base;
    run.detect.smoothness.theta_low_deg = run.detect.smoothness.theta_high_deg = theta;
    run.name = printed("single threshold %g deg", double{theta});
    runs.push_back(run);
  }
}

/// From the paper's settings towards the configured ones, an idea at a time.
void add_paper(const DetectionRun& base, std::vector<DetectionRun>& runs) {
  DetectionRun run = base;
  run.detect = paper_settings(base.detect);
  run.name = "paper, 12/30 deg, k 0.4";
  runs.push_back(run);
  run.detect.smoothness = base.detect.smoothness;
  run.name = printed("paper, %g/%g deg, k %g", double{run.detect.smoothness.theta_low_deg},
                     double{run.detect.smoothness.theta_high_deg}, double{run.detect.smoothness.edge_share});
  runs.push_back(run);
  run.detect.support = base.detect.support;
  run.detect.objects = base.detect.objects;
  run.name = "+ support and objects";
  runs.push_back(run);
  run.detect.check = base.detect.check;
  run.name = "+ gripper checks";
  runs.push_back(run);
  run.detect.ranking = base.detect.ranking;
  run.name = "+ one handle a place";
  runs.push_back(run);
}

void add_voxels(const DetectionRun& base, std::vector<DetectionRun>& runs) {
  for (const float leaf : {0.003f, 0.0045f}) {
    DetectionRun run = base;
    set_voxel(run.detect, leaf);
    run.name = printed("%.1f mm voxels", 1e3 * double{leaf});
    runs.push_back(run);
  }
}

void add_clouds(const DetectionRun& base, std::vector<DetectionRun>& runs) {
  DetectionRun run = base;
  run.change = {false, true};
  run.name = "unorganized";
  runs.push_back(run);
  run.change = {true, false};
  run.name = "half resolution";
  runs.push_back(run);
  run.change = {true, true};
  run.name = "half resolution, unorganized";
  runs.push_back(run);
}

void add_grippers(const DetectionRun& base, std::vector<DetectionRun>& runs) {
  for (const float aperture : {0.040f, 0.060f, 0.080f, 0.110f, 0.140f}) {
    DetectionRun run = base;
    run.gripper.aperture_m = aperture;
    run.name = printed("d = %.0f mm", 1e3 * double{aperture});
    runs.push_back(run);
  }
}

}  // namespace

PointCloud changed(const PointCloud& cloud, const CloudChange& change) {
  if (!change.half && !change.unorganized) return cloud;
  std::vector<std::size_t> kept = kept_points(cloud, change.half);
  if (change.unorganized) {
    std::erase_if(kept, [&](std::size_t i) { return !cloud.point(i).allFinite(); });
    std::shuffle(kept.begin(), kept.end(), std::minstd_rand(1));
  }
  PointCloud result;
  for (const std::size_t i : kept) result.push_back(cloud.point(i));
  const bool organized = cloud.height > 1 && !change.unorganized;
  result.width = organized ? (cloud.width + 1) / 2 : static_cast<int>(kept.size());
  result.height = organized ? (cloud.height + 1) / 2 : 1;
  result.viewpoint = cloud.viewpoint;
  return result;
}

void set_voxel(DetectConfig& config, float leaf_m) {
  config.downsample.leaf_size_m = leaf_m;
  config.neighborhoods.radius_m = std::clamp(config.neighborhoods.radius_m, 2 * leaf_m, 8 * leaf_m);
}

DetectConfig paper_settings(const DetectConfig& config) {
  DetectConfig paper = config;
  paper.smoothness = {12.0f, 30.0f, 0.4f};
  paper.support.enabled = false;
  paper.objects.min_convex_share = 1.0f;
  paper.objects.min_border_pairs = 100'000;
  paper.search.seeds = false;
  paper.search.all_directions = 0;
  HandleCheckConfig& check = paper.check;
  check.clearance_m = 0;
  check.palm_depth_m = 0;
  check.way_m = 0;
  check.support_clearance_m = -0.01f;
  check.min_own_share = 0;
  check.min_grip_depth_m = 0.001f;
  check.min_contact_area_m2 = 0;
  check.max_silhouette_angle_deg = check.max_wall_angle_deg = check.max_facing_angle_deg = 89;
  check.max_hidden_share = 1;
  HandleRankingConfig& ranking = paper.ranking;
  ranking.max_handles = 10'000;
  ranking.max_per_object = 1000;
  ranking.min_score = 0;
  ranking.distinct_distance_m = 0;
  ranking.distinct_angle_deg = 0;
  return paper;
}

std::vector<DetectionRun> variants(const DetectionRun& base, std::string_view group) {
  std::vector<DetectionRun> runs;
  if (group == "thresholds") add_thresholds(base, runs);
  if (group == "paper") add_paper(base, runs);
  if (group == "voxels") add_voxels(base, runs);
  if (group == "clouds") add_clouds(base, runs);
  if (group == "grippers") add_grippers(base, runs);
  return runs;
}

}  // namespace graspd
