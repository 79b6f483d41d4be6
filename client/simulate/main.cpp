// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-simulate: a simulated depth camera over cluttered scenes with known objects.
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "client/common/frame_publisher.hpp"
#include "client/common/program.hpp"
#include "client/common/stop_flag.hpp"
#include "client/common/text.hpp"
#include "client/log/recorder.hpp"
#include "client/simulate/line_file.hpp"
#include "client/simulate/simulation.hpp"
#include "client/simulate/solids_line.hpp"
#include "client/simulate/truth_line.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  std::string channel = "GRASPD_CLOUD";
  std::string frame_name = "camera";
  std::string type = "cloud";
  std::string scene = "table";
  std::string sensor = "kinect";
  std::string output;
  std::string log;
  double log_part_mb = 0;
  std::string truth;
  std::string solids;
  std::string key_file;
  int width = 640;
  double rate_hz = 15;
  std::int64_t frames = 0;
  double elevation_deg = 0;
  double azimuth_deg = 0;
  bool orbit = false;
  double orbit_speed_deg = 10;
  SimulationConfig simulation;
};

void add_options(CLI::App& app, Options& o) {
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("-c,--channel", o.channel, "channel to publish on")->capture_default_str();
  app.add_option("--frame-name", o.frame_name, "name of the optical frame")->capture_default_str();
  app.add_option("-t,--type", o.type, "message: cloud (point_cloud_t) or depth (depth_image_t)")
      ->check(CLI::IsMember({"cloud", "depth"}))
      ->capture_default_str();
  app.add_option("--scene", o.scene, "what the camera sees")
      ->check(CLI::IsMember(scene_kind_names()))
      ->capture_default_str();
  app.add_option(
         "-n,--objects", o.simulation.scene.num_objects,
         "objects in a scene, as many as find a place (default: 8; easy 4, hard 14, extreme 24, household 6)")
      ->check(CLI::Range(0, 200));
  app.add_option("--sensor", o.sensor, "noise, steps, dropouts and edges of which sensor")
      ->check(CLI::IsMember({"ideal", "kinect", "realsense"}))
      ->capture_default_str();
  app.add_option("-s,--seed", o.simulation.seed, "same seed, same frames")->capture_default_str();
  app.add_option("-r,--rate", o.rate_hz, "frames a second; 0: as fast as it can")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_option("--frames", o.frames, "stop after so many; 0: never (10 with --output or --log)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--new-scene-every", o.simulation.new_scene_every, "frames until the next scene; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--orbit", o.orbit, "the camera moves slowly around the scene");
  app.add_option("--orbit-speed", o.orbit_speed_deg, "of --orbit [degrees a second]")->capture_default_str();
  app.add_option("--distance", o.simulation.distance_m, "from the camera to the middle of the scene [m]")
      ->check(CLI::Range(0.3, 3.0))
      ->capture_default_str();
  app.add_option("--elevation", o.elevation_deg,
                 "of the camera above the horizon [degrees] (default: 43, over a bin 63, before a shelf 30)")
      ->check(CLI::Range(5.0, 90.0));
  app.add_option("--azimuth", o.azimuth_deg, "of the camera around the scene [degrees]")
      ->capture_default_str();
  app.add_option("--width", o.width,
                 "of the image [pixels]; its height is 3/4 of that, its field of view the same")
      ->check(CLI::Range(64, 1920))
      ->capture_default_str();
}

void add_output_options(CLI::App& app, Options& o) {
  auto* key = app.add_option("--key", o.key_file, "sign with the first key of this file (see graspd-keygen)");
  app.add_option("--truth", o.truth,
                 "write what each frame shows into this file: the objects' points, as JSON lines");
  app.add_option("--solids", o.solids,
                 "write the true solids of each frame and the camera's pose into this file, as JSON lines");
  auto* output = app.add_option("-o,--output", o.output,
                                "write labelled PCD files into this folder instead of publishing");
  auto* log =
      app.add_option("--log", o.log,
                     "write an LCM event log instead of publishing, as fast as it can; times in it follow "
                     "--rate, from a fixed start")
          ->excludes(key)
          ->excludes(output);
  app.add_option("--log-part", o.log_part_mb,
                 "logs FILE.00, FILE.01, ... of at most so many megabytes; 0: one log FILE")
      ->check(CLI::NonNegativeNumber)
      ->needs(log);
}

SimulationConfig simulation_config(const Options& o) {
  constexpr double kDegree = std::numbers::pi / 180;
  SimulationConfig config = o.simulation;
  config.scene.kind = *scene_kind(o.scene);
  config.sensor = *sensor_model(o.sensor);
  config.camera = scaled(config.camera, o.width);
  const double elevation_deg = o.elevation_deg > 0 ? o.elevation_deg : usual_elevation_deg(config.scene.kind);
  config.elevation_rad = kDegree * elevation_deg;
  config.azimuth_rad = kDegree * o.azimuth_deg;
  // Free running, the camera moves as if it ran at 15 Hz.
  if (o.orbit) config.orbit_rad_per_frame = kDegree * o.orbit_speed_deg / (o.rate_hz > 0 ? o.rate_hz : 15);
  return config;
}

/// The files that --truth and --solids ask for.
class TruthOutput {
 public:
  explicit TruthOutput(const Options& o) {
    if (!o.truth.empty()) truth_.emplace(o.truth);
    if (!o.solids.empty()) solids_.emplace(o.solids);
  }

  /// frame: the simulation's last, number k.
  void write(std::int64_t k, const Simulation& simulation, const DepthFrame& frame) {
    if (truth_) truth_->write(truth_line(k, frame));
    if (solids_) solids_->write(solids_line(k, simulation.scene(), simulation.T_world_camera(k)));
  }

 private:
  std::optional<LineFile> truth_, solids_;
};

int write_files(const CLI::App& app, const Options& o, Simulation& simulation) {
  std::filesystem::create_directories(o.output);
  const std::int64_t frames = o.frames > 0 ? o.frames : 10;
  TruthOutput truth(o);
  std::int64_t k = 0;
  for (; k < frames && !stop_requested(); ++k) {
    const std::filesystem::path path =
        std::filesystem::path(o.output) / (o.frame_name + std::to_string(k) + ".pcd");
    const DepthFrame frame = simulation.frame(k);
    truth.write(k, simulation, frame);
    save_pcd(path, to_cloud(frame));
    if (isatty(STDERR_FILENO))
      std::fprintf(stderr, "\r%lld of %lld", static_cast<long long>(k + 1), static_cast<long long>(frames));
  }
  if (isatty(STDERR_FILENO)) std::fputc('\n', stderr);
  say(app, printed("%lld files in %s", static_cast<long long>(k), o.output.c_str()));
  return kExitOk;
}

void send(FramePublisher& publisher, const Options& o, const FrameHeader& header, const DepthFrame& frame) {
  constexpr double kDepthScale = 0.001;
  if (*message_type(o.type) == MessageType::kCloud) {
    publisher.send_cloud(header, to_cloud(frame));
  } else {
    publisher.send_depth(header, frame.camera, frame.depth_m, kDepthScale);
  }
}

int publish(const CLI::App& app, const Options& o, Simulation& simulation) {
  LcmBus bus(resolve_lcm_url(o.lcm_url));
  FramePublisher publisher(bus, o.channel);
  if (!o.key_file.empty()) publisher.sign_with(o.key_file);
  Pacer pacer(o.rate_hz);
  TruthOutput truth(o);
  for (std::int64_t k = 0; o.frames == 0 || k < o.frames; ++k) {
    // Drawn ahead of its time, so that it goes out on time.
    const DepthFrame frame = simulation.frame(k);
    if (!pacer.next()) break;
    truth.write(k, simulation, frame);
    send(publisher, o, {wall_clock_us(), k, std::pmr::string(o.frame_name)}, frame);
  }
  say(app, publisher.summary());
  return kExitOk;
}

/// As if graspd-log had recorded what publish() sends, with times that depend on the rate alone.
int write_log(const CLI::App& app, const Options& o, Simulation& simulation) {
  constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;
  const double rate_hz = o.rate_hz > 0 ? o.rate_hz : 15;
  Recorder recorder(
      {o.log, static_cast<std::int64_t>(1e6 * o.log_part_mb), 0, EventLogFile::Existing::kRefuse});
  std::int64_t utime = kStartUtime;
  FramePublisher publisher(
      [&](const std::string& channel, std::span<const std::byte> bytes) {
        recorder.record(utime, channel, bytes);
        return true;
      },
      o.channel);
  TruthOutput truth(o);
  const std::int64_t frames = o.frames > 0 ? o.frames : 10;
  for (std::int64_t k = 0; k < frames && !stop_requested(); ++k) {
    utime = kStartUtime + std::llround(1e6 * static_cast<double>(k) / rate_hz);
    const DepthFrame frame = simulation.frame(k);
    truth.write(k, simulation, frame);
    send(publisher, o, {utime, k, std::pmr::string(o.frame_name)}, frame);
  }
  say(app, publisher.summary());
  return kExitOk;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("A simulated depth camera over cluttered tables and bins, published as clouds.",
               "graspd-simulate");
  Options options;
  add_options(app, options);
  add_output_options(app, options);
  return run_program(app, argc, argv, [&] {
    Simulation simulation(simulation_config(options));
    if (!options.log.empty()) return write_log(app, options, simulation);
    return options.output.empty() ? publish(app, options, simulation) : write_files(app, options, simulation);
  });
}
