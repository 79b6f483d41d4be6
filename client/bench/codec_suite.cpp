// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <thread>
#include <variant>

#include "client/bench/measure.hpp"
#include "client/bench/suites.hpp"
#include "client/common/stop_flag.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

struct Message {
  std::string name;
  std::vector<std::byte> bytes;
};

std::vector<Message> messages(const BenchOptions& options) {
  const auto [camera, cloud] = simulated_image(options, 0, options.width);
  const FrameHeader header{1, 1, "camera"};
  constexpr double kMillimetre = 0.001;
  const DepthCamera intrinsics{camera.width, camera.height, camera.fx,  camera.fy,
                               camera.cx,    camera.cy,     kMillimetre};
  return {{"point_cloud_t", encode(make_point_cloud(header, cloud))},
          {"depth_image_t", encode(make_depth_image(header, intrinsics, depth_units(cloud.z, kMillimetre)))}};
}

Frame decoded(const std::vector<std::byte>& message) {
  auto frame = decode_cloud(message, DecodeLimits{});
  if (const auto* refusal = std::get_if<Refusal>(&frame)) throw std::logic_error(refusal->text);
  return std::get<Frame>(std::move(frame));
}

/// As the daemon does it; the answer goes to a buffer that is kept.
struct FrameRun {
  TimedDetection detection;
  double decode_ms = 0, encode_ms = 0, whole_ms = 0;
  std::size_t points = 0;
};

FrameRun run_frame(const std::vector<std::byte>& message, const DetectConfig& config, tbb::task_arena& arena,
                   HandleListMessage& answer) {
  FrameRun run;
  LapTimer whole, part;
  const Frame frame = decoded(message);
  run.decode_ms = part.lap_ms();
  run.detection = timed_detection(frame.cloud, config, arena);
  (void)part.lap_ms();
  HandleListHeader header;
  header.utime = frame.utime;
  header.seq = frame.seq;
  header.source_channel = "CAMERA";
  header.frame_name = frame.frame_name;
  header.stages_ms.assign(run.detection.stages_ms.begin(), run.detection.stages_ms.end());
  header.status = wire_status(run.detection.detection.status);
  encode(header, Gripper{}, run.detection.detection, Eigen::Isometry3f::Identity(), answer);
  run.encode_ms = part.lap_ms();
  run.whole_ms = whole.lap_ms();
  run.points = frame.cloud.size();
  return run;
}

BenchResult measure_message(const Message& message, int threads, const BenchOptions& options) {
  ThreadLimit limit(threads);
  const DetectConfig config;
  const DetectConfig plain = plain_config(config);
  HandleListMessage answer;
  const FrameRun warm = run_frame(message.bytes, config, limit.arena(), answer);
  BenchResult result{"codec", message.name, threads, warm.points, warm.detection.detection.points_used, {},
                     {}};
  result.figures = {{"message_bytes", static_cast<double>(message.bytes.size())},
                    {"answer_bytes", static_cast<double>(answer.bytes.size())},
                    {"handles", static_cast<double>(warm.detection.detection.handles.size())}};
  for (int round = 0; round < options.rounds && !(round > 0 && stop_requested()); ++round) {
    const FrameRun run = run_frame(message.bytes, config, limit.arena(), answer);
    result.add_time(kWhole, run.whole_ms);
    result.add_time("decode", run.decode_ms);
    result.add_time("detect", run.detection.total_ms);
    result.add_time("encode", run.encode_ms);
    for (const auto& [stage, ms] : run.detection.stages_ms) result.add_time("stage " + stage, ms);
    if (options.paper)
      result.add_time(kPlain, run_frame(message.bytes, plain, limit.arena(), answer).whole_ms);
  }
  result.figures.emplace_back("p99_to_median",
                              result.find(kWhole)->quantile(0.99) / result.find(kWhole)->median());
  return result;
}

}  // namespace

void run_codec(const BenchOptions& options, const ResultSink& sink) {
  const int all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (const Message& message : messages(options))
    for (const int threads : outer_thread_counts(options, all)) {
      if (stop_requested()) return;
      sink(measure_message(message, threads, options));
    }
}

}  // namespace graspd
