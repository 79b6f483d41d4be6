// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/replay_run.hpp"

#include <utility>

#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "client/replay/progress_line.hpp"

namespace graspd {
namespace {

void say_what_was_done(const CLI::App& app, const ReplayState& start, const ReplayState& state,
                       double seconds, std::int64_t bytes) {
  const auto frames = state.frames - start.frames;
  say(app, printed("%lld frames in %.1f s: %.1f frames/s, %.1f MB/s; %lld handles; %s",
                   static_cast<long long>(frames), seconds, static_cast<double>(frames) / seconds,
                   1e-6 * static_cast<double>(bytes) / seconds,
                   static_cast<long long>(state.handles - start.handles), answers_text(state).c_str()));
  if (start.frames > 0) say(app, printed("went on after %lld frames", static_cast<long long>(start.frames)));
  if (state.input.skipped > 0)
    say(app, printed("%lld bytes of the logs are damaged and were skipped",
                     static_cast<long long>(state.input.skipped)));
}

}  // namespace

std::string answers_text(const ReplayState& state) {
  std::string text;
  for (const auto& [status, count] : state.answers)
    text += (text.empty() ? "" : ", ") + status + ' ' + std::to_string(count);
  return text.empty() ? "no frames" : text;
}

std::optional<Receipt> replay_to(const CLI::App& app, const ReplayConfig& config,
                                 const std::filesystem::path& file, OldOutput old) {
  ReplayOutput output(file, identity_of(config), old);
  if (output.complete()) {
    say(app, file.string() + ": complete already: " + answers_text(output.complete()->state));
    return output.complete();
  }
  const auto begin = std::chrono::steady_clock::now();
  Replay replay(config, output);
  std::int64_t first_bytes = -1, bytes = 0;
  bool finished = false, told = false;
  {
    ProgressLine line;
    finished = replay.run([&](const ReplayProgress& progress) {
      if (replay.unopened() > 0 && !std::exchange(told, true)) {
        line.clear();
        say(app, "signed clouds (sealed_t) are refused without the key that opens them: --key FILE");
      }
      if (first_bytes < 0) first_bytes = progress.bytes_done;
      bytes = progress.bytes_done - first_bytes;
      line.show(progress.state.frames, progress.bytes_done, progress.bytes_in_all);
    });
  }
  const double seconds =
      std::max(1e-3, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  std::optional<Receipt> receipt;
  if (finished) receipt = output.finish(replay.state());
  say_what_was_done(app, output.start(), replay.state(), seconds, bytes);
  if (replay.unopened() > 0)
    say(app, printed("%lld clouds are signed and were refused: --key FILE opens them",
                     static_cast<long long>(replay.unopened())));
  if (!finished) say(app, file.string() + ": stopped; --resume goes on");
  return receipt;
}

}  // namespace graspd
