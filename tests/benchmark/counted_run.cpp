// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-bench-counted: detections on one thread, for callgrind. It alone counts between the frames' begin
// and end, and writes its counts whenever a stage is done, under the stage's name. Prints what was run.
//   graspd-bench-counted [FILES]   PCD or PLY files or folders of them; without: simulated scenes
#include <valgrind/callgrind.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "client/bench/bench_clouds.hpp"
#include "client/bench/measure.hpp"
#include "service/pipeline/point_kernels.hpp"
#include "service/runtime/kept_memory.hpp"

namespace graspd {
namespace {

/// One detection under a name.
struct Work {
  std::string name;
  BenchCloud bench;
  DetectConfig config;
};

/// What comes from a camera: the files, or a simulated image.
std::vector<BenchCloud> images(BenchOptions options) {
  if (options.inputs.empty()) return {{"image", simulated_image(options, 0, options.width).cloud, 0}};
  options.full = true;
  return stage_clouds(options);
}

/// Voxels as the suite stages has them, the same with the paper's own candidates, and images with the default
/// configuration.
std::vector<Work> works(const BenchOptions& options) {
  std::vector<Work> list;
  for (const BenchCloud& bench : stage_clouds(options))
    list.push_back({"voxels", bench, config_at(bench.leaf_m)});
  for (std::size_t i = list.size(); i-- > 0;)
    list.push_back({"plain", list[i].bench, plain_config(list[i].config)});
  for (BenchCloud& image : images(options)) list.push_back({"image", std::move(image), DetectConfig{}});
  return list;
}

void run_counted(const Work& work) {
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  const Detection detection =
      detect_handles(work.bench.cloud, Gripper{}, work.config, [&](std::string_view stage) {
        const std::string name = work.name + "/" + std::string(stage);
        CALLGRIND_DUMP_STATS_AT(name.c_str());
      });
  CALLGRIND_STOP_INSTRUMENTATION;
  std::printf("points %s %zu\n", work.name.c_str(), work.bench.cloud.size());
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  BenchOptions options;
  options.inputs.assign(argv + 1, argv + argc);
  keep_memory();  // as the daemon does
  ThreadLimit one_thread(1);
  std::printf("kernels %s\n", avx2_kernels() ? "avx2" : "portable");
  std::printf("compiler %s\n", __VERSION__);
  for (const Work& work : works(options)) {
    // Code and tables that are set up once do not count.
    (void)timed_detection(work.bench.cloud, work.config, one_thread.arena());
    one_thread.arena().execute([&] { run_counted(work); });
  }
  return 0;
}
