// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/bench_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace graspd {
namespace {

constexpr std::array<std::string_view, 5> kSuites{"stages", "points", "organized", "codec", "lcm"};
constexpr std::array<std::string_view, 3> kQuick{"stages", "points", "codec"};

bool has(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::optional<std::string> problem(const BenchOptions& options) {
  const std::vector<std::string> suites = suites_to_run(options);
  if (!options.inputs.empty() && !has(suites, "stages")) return "files are for the suite stages alone";
  if (options.full && !has(suites, "stages")) return "--full is for the suite stages alone";
  if (!options.points.empty() && !has(suites, "points")) return "--points is for the suite points alone";
  if (options.hogs > 0 && !has(suites, "lcm")) return "--hog is for the suite lcm alone";
  if (!options.plot_file.empty() && !has(suites, "points")) return "--plot shows the suite points";
  if (!options.plot_file.empty() && point_counts(options).size() < 2)
    return "--plot needs two sizes at least";
  return std::nullopt;
}

std::vector<std::string> suite_names() {
  std::vector<std::string> names(kSuites.begin(), kSuites.end());
  names.emplace_back("all");
  return names;
}

std::vector<std::string> suites_to_run(const BenchOptions& options) {
  if (options.suites.empty()) return {kQuick.begin(), kQuick.end()};
  std::vector<std::string> suites;
  for (const std::string_view suite : kSuites)
    if (has(options.suites, suite) || has(options.suites, "all")) suites.emplace_back(suite);
  return suites;
}

std::vector<std::int64_t> point_counts(const BenchOptions& options) {
  if (!options.points.empty()) return options.points;
  if (options.suites.empty()) return {10'000, 43'000, 100'000};
  return {10'000, 20'000, 43'000, 100'000, 200'000, 400'000, 1'000'000};
}

std::vector<int> thread_counts(const BenchOptions& options, int all) {
  if (!options.threads.empty()) return options.threads;
  std::vector<int> counts;
  for (int n = 1; n < all; n += n < 4 ? 1 : n) counts.push_back(n);
  counts.push_back(all);
  return counts;
}

std::vector<int> outer_thread_counts(const BenchOptions& options, int all) {
  if (!options.threads.empty()) return options.threads;
  return all > 1 ? std::vector<int>{1, all} : std::vector<int>{1};
}

DetectConfig config_at(float leaf_m) {
  DetectConfig config;
  config.downsample.leaf_size_m = leaf_m;
  config.neighborhoods.radius_m = 3 * leaf_m;
  return config;
}

DetectConfig plain_config(DetectConfig config) {
  config.search.seeds = false;
  config.search.all_directions = 0;
  config.support.enabled = false;
  config.container.enabled = false;
  config.objects.min_convex_share = 1;
  config.objects.min_whole_convex_share = 1;
  config.check.way_m = 0;
  config.check.palm_depth_m = 0;
  config.check.min_own_share = 0;
  config.check.min_contact_area_m2 = 0;
  config.check.max_silhouette_angle_deg = 89;
  config.check.max_wall_angle_deg = 89;
  config.check.max_facing_angle_deg = 90;
  config.check.max_misalignment_deg = 89;
  config.check.max_hidden_share = 1;
  return config;
}

}  // namespace graspd
