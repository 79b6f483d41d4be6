// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-meldis: what graspd finds, drawn by Drake's viewer Meldis.
#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>

#include "client/common/frame_publisher.hpp"
#include "client/common/lcm_loop.hpp"
#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "client/meldis/meldis_messages.hpp"
#include "service/transport/encoding.hpp"
#include "service/transport/seal_keys.hpp"
#include "service/transport/sealer.hpp"
#include "service/transport/segmentation_codec.hpp"
#include "service/transport/segmentation_request_codec.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  std::string handles = "GRASPD_HANDLES";
  std::string segments = "GRASPD_SEGMENTS";
  std::string requests = "GRASPD_REQUESTS";
  std::string name = "GRASPD";
  std::size_t max_handles = 5;
  bool no_grippers = false;
  std::string key_file;
  std::int64_t count = 0;
};

void add_options(CLI::App& app, Options& o) {
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("--handles", o.handles, "channel of handle lists")->capture_default_str();
  app.add_option("--segments", o.segments, "channel of segmentations; empty: no cloud is drawn")
      ->capture_default_str();
  app.add_option("--requests", o.requests,
                 "channel on which segmentations are asked for; empty: nobody is asked")
      ->capture_default_str();
  app.add_option("--name", o.name,
                 "end of Meldis' channels: one program for each source, each with its own name")
      ->capture_default_str();
  app.add_option("--max-handles", o.max_handles, "how many handles are drawn, the best ones")
      ->capture_default_str();
  app.add_flag("--no-grippers", o.no_grippers, "draws frames and the cloud, but no grippers");
  app.add_option("--key", o.key_file, "sign requests with the first key of this file (see graspd-keygen)");
  app.add_option("-n,--count", o.count, "stop after so many handle lists; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

/// Draws each message as it comes.
class Drawing {
 public:
  Drawing(LcmBus& bus, const Options& options) : bus_(bus), o_(options) {
    if (!o_.key_file.empty()) sealer_.emplace(load_seal_keys(o_.key_file).front());
  }

  void subscribe() {
    bus_.subscribe(o_.handles, [this](const Packet& packet) { draw_handles(packet); });
    if (!o_.segments.empty())
      bus_.subscribe(o_.segments, [this](const Packet& packet) { draw_cloud(packet); });
  }

  /// Once a second a request that outlives the next.
  void ask() {
    using std::chrono::steady_clock;
    const auto now = steady_clock::now();
    if (o_.segments.empty() || o_.requests.empty() || now < next_request_) return;
    next_request_ = now + std::chrono::seconds(1);
    segmentation_request_t request{};
    request.utime = wall_clock_us();
    request.seconds = 3;
    const auto message = encode(request);
    bus_.publish(o_.requests, sealer_ ? sealer_->seal(o_.requests, message, request.utime) : message);
  }

  [[nodiscard]] std::int64_t lists() const { return lists_; }
  [[nodiscard]] std::int64_t invalid() const { return invalid_; }

 private:
  void draw_handles(const Packet& packet) {
    const auto list = decode_handle_list(packet.bytes);
    if (!list) {
      ++invalid_;
      return;
    }
    ++lists_;
    publish("DRAKE_DRAW_FRAMES_" + o_.name, handle_frames(*list, o_.max_handles));
    if (o_.no_grippers) return;
    publish("DRAKE_VIEWER_DRAW", no_poses());
    publish("DRAKE_VIEWER_DEFORMABLE", handle_grippers(*list, o_.max_handles));
  }

  void draw_cloud(const Packet& packet) {
    const auto segmentation = decode_segmentation(packet.bytes);
    if (segmentation) {
      publish("DRAKE_POINT_CLOUD_" + o_.name, coloured_cloud(*segmentation));
    } else {
      ++invalid_;
    }
  }

  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    encode_message(message, buffer_);
    bus_.publish(channel, buffer_);
  }

  LcmBus& bus_;
  const Options& o_;
  std::optional<Sealer> sealer_;
  std::vector<std::byte> buffer_;
  std::chrono::steady_clock::time_point next_request_;
  std::int64_t lists_ = 0;
  std::int64_t invalid_ = 0;
};

int draw(const CLI::App& app, const Options& o) {
  const std::string url = resolve_lcm_url(o.lcm_url);
  LcmBus bus(url);
  Drawing drawing(bus, o);
  drawing.subscribe();
  drawing.ask();
  const LoopEnd end = run_loop(
      bus, std::nullopt, [&] { return o.count > 0 && drawing.lists() >= o.count; }, [&] { drawing.ask(); });
  if (drawing.invalid() > 0)
    say(app, printed("%lld invalid messages", static_cast<long long>(drawing.invalid())));
  return exit_code(app, end, url);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Shows handles, grippers and segments in Drake's viewer Meldis.", "graspd-meldis");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return draw(app, options); });
}
