// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/client/sample_list.hpp"

#include <cmath>

#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

/// On its own, because GCC 12 leaves the rounding to float out where it turns a row of these into vectors.
[[gnu::noinline]] float awkward(Rng& rng) {
  return static_cast<float>(rng.uniform(-1, 1) * std::pow(10.0, rng.index(12) - 8));
}

}  // namespace

handle_list_t sample_list(int num_handles, unsigned seed) {
  Rng rng(seed);
  handle_list_t list{};
  list.utime = 1'700'000'000'123'456;
  list.seq = 7;
  list.source_channel = "GRASPD_CLOUD";
  list.frame_name = "learn7";
  list.gripper.name = "paper_80mm";
  list.gripper.aperture = static_cast<double>(0.08f);
  list.status = num_handles > 0 ? handle_list_t::OK : handle_list_t::NO_HANDLES;
  list.status_text = "as found";
  list.config_revision = 3;
  list.voxel_size = static_cast<double>(0.003f);
  list.points_in = 307200;
  list.points_used = 43210;
  list.num_segments = 12;
  list.num_candidates = 345;
  list.candidate_failures = {{"fingers", 17}, {"palm", 3}};
  list.num_candidate_failures = 2;
  list.stages = {{"normals", 4.25}, {"handle_check", 10.5}};
  list.num_stages = 2;
  list.latency = 0.0312;
  for (int i = 0; i < num_handles; ++i) {
    handle_t handle{};
    handle.id = i;
    handle.segment_id = 3 * i;
    for (double* values :
         {handle.position, handle.rpy, handle.approach, handle.closing_axis, handle.major_axis}) {
      for (int k = 0; k < 3; ++k) values[k] = static_cast<double>(awkward(rng));
    }
    for (double& v : handle.orientation) v = static_cast<double>(awkward(rng));
    handle.width = static_cast<double>(awkward(rng));
    for (int k = 0; k < 2; ++k) {
      handle.gap[k] = static_cast<double>(awkward(rng));
      handle.observed_free[k] = static_cast<double>(awkward(rng));
    }
    handle.num_points = 100 + i;
    handle.score = static_cast<double>(awkward(rng));
    list.handles.push_back(handle);
  }
  list.num_handles = num_handles;
  return list;
}

}  // namespace graspd
