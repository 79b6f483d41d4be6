// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-publish: clouds from files to a channel.
#include <CLI/CLI.hpp>
#include <variant>

#include "client/common/cloud_list.hpp"
#include "client/common/frame_publisher.hpp"
#include "client/common/program.hpp"
#include "client/common/stop_flag.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  std::vector<std::string> inputs;
  std::string channel = "GRASPD_CLOUD";
  std::string frame_name;
  std::string key_file;
  std::string type = "cloud";
  double rate_hz = 10;
  double delay_s = 0;
  double depth_scale_m = 0.001;
  std::int64_t count = 0;
  std::int64_t first_seq = 0;
  bool loop = false;
};

void add_options(CLI::App& app, Options& o) {
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("files", o.inputs, "PCD or PLY files, or folders of them (learn2 comes before learn10)")
      ->required();
  app.add_option("-c,--channel", o.channel, "channel to publish on")->capture_default_str();
  app.add_option("-t,--type", o.type,
                 "message: cloud (point_cloud_t) or depth (depth_image_t, pinhole images only)")
      ->check(CLI::IsMember({"cloud", "depth"}))
      ->capture_default_str();
  app.add_option("-r,--rate", o.rate_hz, "frames a second; 0: as fast as it can")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_option("-n,--count", o.count, "stop after so many frames; 0: at the end of the files")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--loop", o.loop, "start over at the end of the files");
  app.add_option("--frame-name", o.frame_name,
                 "name of the frame (default: the file's name without its ending)");
  app.add_option("--first-seq", o.first_seq, "sequence number of the first frame")->capture_default_str();
  app.add_option("--depth-scale", o.depth_scale_m, "of one unit of depth [m]")
      ->check(CLI::Range(1e-5, 0.1))
      ->capture_default_str();
  app.add_option("--key", o.key_file, "sign with the first key of this file (see graspd-keygen)");
  app.add_option("--delay", o.delay_s, "wait before the first frame, for listeners to start [s]")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
}

Pinhole pinhole_of(const std::filesystem::path& path, const PointCloud& cloud) {
  auto fit = estimate_pinhole(cloud);
  if (const auto* problem = std::get_if<std::string>(&fit)) {
    throw CloudFileError(path.string() + ": no depth image can be made of it: " + *problem);
  }
  return std::get<Pinhole>(fit);
}

/// Loads and sends one file in its slot; false when a stop was requested.
bool send_file(const Options& o, const std::filesystem::path& path, Pacer& pacer, FramePublisher& publisher) {
  const LabelledCloud labelled = load_cloud(path);
  const bool depth = *message_type(o.type) == MessageType::kDepth;
  const Pinhole camera = depth ? pinhole_of(path, labelled.cloud) : Pinhole{};
  if (!pacer.next()) return false;
  const std::string name = o.frame_name.empty() ? path.stem().string() : o.frame_name;
  const FrameHeader header{wall_clock_us(), o.first_seq + publisher.frames(), std::pmr::string(name)};
  if (depth) {
    publisher.send_depth(header, camera, labelled.cloud.z, o.depth_scale_m);
  } else {
    publisher.send_cloud(header, labelled);
  }
  return true;
}

void send_all(const Options& o, const std::vector<std::filesystem::path>& files, FramePublisher& publisher) {
  const auto delay =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(o.delay_s));
  if (!wait_until(std::chrono::steady_clock::now() + delay)) return;
  Pacer pacer(o.rate_hz);
  do {
    for (const auto& path : files) {
      if (o.count > 0 && publisher.frames() >= o.count) return;
      if (!send_file(o, path, pacer, publisher)) return;
    }
  } while (o.loop);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Publishes clouds from PCD and PLY files.", "graspd-publish");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] {
    const auto files = list_cloud_files(options.inputs);
    LcmBus bus(resolve_lcm_url(options.lcm_url));
    FramePublisher publisher(bus, options.channel);
    if (!options.key_file.empty()) publisher.sign_with(options.key_file);
    try {
      send_all(options, files, publisher);
    } catch (...) {
      if (publisher.frames() > 0) say(app, publisher.summary());
      throw;
    }
    say(app, publisher.summary());
    return static_cast<int>(kExitOk);
  });
}
