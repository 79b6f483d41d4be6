// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "client/bench/bench_clouds.hpp"
#include "client/bench/cpu_hogs.hpp"
#include "client/bench/daemon_process.hpp"
#include "client/bench/suites.hpp"
#include "client/common/answer_summary.hpp"
#include "client/common/frame_publisher.hpp"
#include "client/common/stop_flag.hpp"
#include "client/common/text.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/lcm_bus.hpp"

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr const char* kCloudChannel = "GRASPD_CLOUD";
constexpr const char* kHandlesChannel = "GRASPD_HANDLES";
constexpr std::chrono::seconds kPatience{60};  // an end to waiting, no measure of speed
constexpr int kWarmUpFrames = 20;

/// A group and a port that no other program of the machine is likely to use.
std::string private_url() {
  return printed("udpm://239.255.76.99:%d?ttl=0", 20000 + static_cast<int>(getpid()) % 20000);
}

/// Depth images of the scenes, one after the other.
class Camera {
 public:
  explicit Camera(const BenchOptions& options) {
    for (int i = 0; i < options.scenes; ++i) {
      const auto [pinhole, cloud] = simulated_image(options, i, options.width);
      const DepthCamera camera{pinhole.width, pinhole.height, pinhole.fx,   pinhole.fy,
                               pinhole.cx,    pinhole.cy,     kMillimetre_m};
      images_.push_back(make_depth_image({0, 0, "camera"}, camera, depth_units(cloud.z, kMillimetre_m)));
    }
  }

  /// The message of one frame, in a buffer that is kept.
  const std::vector<std::byte>& message(std::int64_t seq) {
    depth_image_t& image = images_[static_cast<std::size_t>(seq) % images_.size()];
    image.utime = wall_clock_us();
    image.seq = seq;
    encode(image, buffer_);
    return buffer_;
  }

 private:
  static constexpr double kMillimetre_m = 0.001;
  std::vector<depth_image_t> images_;
  std::vector<std::byte> buffer_;
};

/// What the daemon answered, by the thread that listens.
class Answers {
 public:
  explicit Answers(const std::string& url) : bus_(url) {
    bus_.subscribe(kHandlesChannel, [this](const Packet& packet) { take(packet); });
  }

  void sent(std::int64_t seq, Clock::time_point at) {
    const std::lock_guard lock(mutex_);
    sent_.resize(static_cast<std::size_t>(seq) + 1, at);
  }
  void wait() { (void)bus_.wait(milliseconds(20)); }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::int64_t dropped() const { return dropped_; }
  [[nodiscard]] std::int64_t degraded() const { return degraded_; }
  [[nodiscard]] const Samples& latency_ms() const { return latency_ms_; }
  /// Counts answers to frames from this one on, and no others.
  void count_from(std::int64_t seq) {
    first_seq_ = seq;
    latency_ms_ = {};
    count_ = dropped_ = degraded_ = 0;
  }

 private:
  void take(const Packet& packet) {
    const auto now = Clock::now();
    const auto list = decode_handle_list(packet.bytes);
    if (!list || list->seq < first_seq_) return;
    ++count_;
    if (list->status == handle_list_t::OVERLOADED) ++dropped_;
    if (list->degraded != 0) ++degraded_;
    if (!is_processed(*list)) return;
    const std::lock_guard lock(mutex_);
    const auto seq = static_cast<std::size_t>(list->seq);
    if (seq < sent_.size())
      latency_ms_.add(std::chrono::duration<double, std::milli>(now - sent_[seq]).count());
  }

  LcmBus bus_;
  std::mutex mutex_;
  std::vector<Clock::time_point> sent_;  // by seq
  std::atomic<std::int64_t> count_ = 0, dropped_ = 0, degraded_ = 0;
  std::int64_t first_seq_ = 0;
  Samples latency_ms_;  // of the listening thread
};

/// The camera on one thread, the listener on this one.
class Session {
 public:
  Session(const BenchOptions& options, const std::string& url)
      : camera_(options), bus_(url), answers_(url), daemon_(arguments(options, url)), hogs_(options.hogs) {
    await_daemon();
  }

  BenchResult run(const BenchOptions& options, double rate_hz);

 private:
  static std::vector<std::string> arguments(const BenchOptions& options, const std::string& url) {
    std::vector<std::string> list{
        options.daemon_program.empty() ? program_beside("graspd") : options.daemon_program, "-l", url};
    if (!options.daemon_config.empty()) list.insert(list.end(), {"--config", options.daemon_config});
    return list;
  }

  void publish() {
    const std::vector<std::byte>& message = camera_.message(next_seq_);
    answers_.sent(next_seq_, Clock::now());
    if (!bus_.publish(kCloudChannel, message)) throw std::runtime_error("a depth image could not be sent");
    ++next_seq_;
  }

  /// Publishes frames until one is answered.
  void await_daemon() {
    const auto deadline = Clock::now() + kPatience;
    while (answers_.count() == 0) {
      if (!daemon_.running() || Clock::now() > deadline)
        throw std::runtime_error("graspd does not answer; it said: " + plain_line(daemon_.said()));
      publish();
      for (int i = 0; i < 10 && answers_.count() == 0; ++i) answers_.wait();
    }
  }

  /// Listens until so many answers came, or nothing has come for some time.
  void await_answers(std::int64_t count) {
    std::int64_t last = answers_.count();
    for (auto since = Clock::now(); answers_.count() < count && Clock::now() - since < milliseconds(1500);) {
      answers_.wait();
      if (answers_.count() != last) since = Clock::now();
      last = answers_.count();
    }
  }

  /// Publishes frames at the rate, and listens meanwhile and until the last answer; returns their number.
  std::int64_t send(std::int64_t frames, double rate_hz) {
    std::atomic<std::int64_t> sent = 0;
    std::atomic<bool> done = false;
    std::exception_ptr error;
    {
      const std::jthread camera([&](const std::stop_token& stop) {
        try {
          for (Pacer pacer(rate_hz); sent < frames && !stop.stop_requested() && pacer.next(); ++sent)
            publish();
        } catch (...) {
          error = std::current_exception();
        }
        done = true;
      });
      while (!done) answers_.wait();
    }
    if (error) std::rethrow_exception(error);
    await_answers(sent);
    return sent;
  }

  Camera camera_;
  LcmBus bus_;
  Answers answers_;
  DaemonProcess daemon_;
  CpuHogs hogs_;
  std::int64_t next_seq_ = 0;
};

BenchResult Session::run(const BenchOptions& options, double rate_hz) {
  answers_.count_from(next_seq_);
  (void)send(kWarmUpFrames, rate_hz);
  answers_.count_from(next_seq_);
  const double cpu_before = daemon_.cpu_seconds(), hogged_before = hogs_.cpu_seconds();
  const auto start = Clock::now();
  const std::int64_t sent = send(std::max<std::int64_t>(1, std::llround(options.seconds * rate_hz)), rate_hz);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::string beside =
      options.hogs > 0 ? printed(", %d hog%s", options.hogs, options.hogs == 1 ? "" : "s") : "";
  BenchResult result{"lcm", printed("%g Hz", rate_hz) + beside, 0, 0, 0, {}, {}};
  result.times.push_back({std::string(kWhole), answers_.latency_ms()});
  result.figures = {{"sent", static_cast<double>(sent)},
                    {"answers", static_cast<double>(answers_.count())},
                    {"dropped", static_cast<double>(answers_.dropped())},
                    {"degraded", static_cast<double>(answers_.degraded())},
                    {"lost", static_cast<double>(sent - answers_.count())},
                    {"message_bytes", static_cast<double>(camera_.message(next_seq_).size())},
                    {"daemon_cores", (daemon_.cpu_seconds() - cpu_before) / seconds},
                    {"daemon_peak_bytes", daemon_.peak_bytes()},
                    {"hogs", static_cast<double>(options.hogs)},
                    {"hog_cores", (hogs_.cpu_seconds() - hogged_before) / seconds}};
  return result;
}

}  // namespace

void run_lcm(const BenchOptions& options, const ResultSink& sink) {
  const std::string url = resolve_lcm_url(private_url());
  Session session(options, url);
  for (const double rate_hz : options.rates_hz) {
    if (stop_requested()) return;
    sink(session.run(options, rate_hz));
  }
}

}  // namespace graspd
