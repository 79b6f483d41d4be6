// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-draw: a frame as a picture, without a display.
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "client/common/program.hpp"
#include "client/common/replace_file.hpp"
#include "client/common/sealed_message.hpp"
#include "client/detect/detect_options.hpp"
#include "client/draw/drawn_frame.hpp"

namespace graspd {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string output;
  std::size_t number = 0;
  std::string key_file;
  std::string view = "camera";
  std::string color = "segment";
  std::string size = "960x720";
  DetectOptions detect;
  PictureOptions picture;
};

const std::vector<std::string> kViews{"camera", "top", "front"};    // in the order of PictureView
const std::vector<std::string> kColors{"segment", "rgb", "depth"};  // in the order of PictureColor

/// The value of that name; the options have been checked.
template <class Choice>
Choice chosen(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Choice>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// "WxH", each 64 to 8192; else a reason.
std::string read_size(const std::string& text, PictureOptions& picture) {
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, picture.width);
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, picture.height);
    const auto can_be = [](int side) { return side >= 64 && side <= 8192; };
    if (height.ec == std::errc{} && height.ptr == end && can_be(picture.width) && can_be(picture.height))
      return {};
  }
  return "expected WIDTHxHEIGHT, each 64 to 8192 pixels";
}

void add_options(CLI::App& app, Options& o) {
  add_version(app);
  app.add_option("files", o.inputs, "PCD or PLY files, folders of them, or LCM event logs")->required();
  app.add_option("-o,--output", o.output, "the PNG file; - for standard output")->required();
  app.add_option("--frame", o.number, "which one of all frames, from 0")->capture_default_str();
  app.add_option("--key", o.key_file, "opens signed messages (sealed_t) of logs");
  app.add_option("--view", o.view, "where it is seen from")
      ->check(CLI::IsMember(kViews))
      ->capture_default_str();
  app.add_option("--color", o.color, "of the points; rgb where the frame has it, else by depth")
      ->check(CLI::IsMember(kColors))
      ->capture_default_str();
  app.add_option("--size", o.size, "WIDTHxHEIGHT [pixels]")
      ->check([&o](const std::string& text) { return read_size(text, o.picture); })
      ->capture_default_str();
  app.add_option("--handles", o.picture.max_handles, "handles drawn at most, the best ones")
      ->capture_default_str();
  app.add_flag("--all", o.picture.whole_cloud, "show the whole cloud, not only what stands on the support");
  add_detect_options(app, o.detect);
}

int draw(const CLI::App& app, const Options& o) {
  const SourceConfig source = source_config(o.detect);
  const int threads = thread_count(o.detect);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  const std::vector<SealKey> keys = seal_keys_of(o.key_file);
  std::vector<std::string> problems;
  PictureFrame frame;
  const auto say_problems = [&] {
    for (const std::string& problem : problems) say(app, problem);
  };
  try {
    arena.execute([&] { frame = find_drawn_frame(o.inputs, o.number, source, keys, problems); });
  } catch (const std::exception&) {
    say_problems();  // they may be why
    throw;
  }
  say_problems();
  PictureOptions picture = o.picture;
  picture.view = chosen<PictureView>(kViews, o.view);
  picture.color = chosen<PictureColor>(kColors, o.color);
  if (picture.color == PictureColor::kRgb && frame.cloud.rgb.empty())
    say(app, "the frame has no colours: drawn by depth");
  const std::string png = encode_png(draw_picture(frame, picture));
  if (o.output == "-") {
    write_output(png);
  } else {
    replace_file(o.output, png);
  }
  return kExitOk;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Draws a frame: its points, its segments and the gripper at its handles.", "graspd-draw");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return draw(app, options); });
}
