// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-bench-counted: detections on one thread, for callgrind. It alone counts between the frames' begin
// and end, and writes its counts whenever a stage is done, under the stage's name. Prints what was run.
#include <valgrind/callgrind.h>

#include <cstdio>
#include <string>

#include "client/bench/bench_clouds.hpp"
#include "client/bench/measure.hpp"
#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

/// As the suite stages has them.
std::vector<BenchCloud> scenes() {
  BenchOptions options;
  options.scenes = 2;
  return stage_clouds(options);
}

void run_counted(const PointCloud& cloud, const DetectConfig& config) {
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  const Detection detection = detect_handles(cloud, Gripper{}, config, [](std::string_view stage) {
    const std::string name(stage);
    CALLGRIND_DUMP_STATS_AT(name.c_str());
  });
  CALLGRIND_STOP_INSTRUMENTATION;
  std::printf("points %zu\n", cloud.size());
}

}  // namespace
}  // namespace graspd

int main() {
  using namespace graspd;
  ThreadLimit one_thread(1);
  std::printf("kernels %s\n", avx2_kernels() ? "avx2" : "portable");
  std::printf("compiler %s\n", __VERSION__);
  for (const BenchCloud& bench : scenes()) {
    const DetectConfig config = config_at(bench.leaf_m);
    // Code and tables that are set up once do not count.
    (void)timed_detection(bench.cloud, config, one_thread.arena());
    one_thread.arena().execute([&] { run_counted(bench.cloud, config); });
  }
  return 0;
}
