// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmark/bench_report.hpp"

#include <cstdarg>
#include <cstdio>

#include "client/common/json_writer.hpp"

namespace graspd {
namespace {

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return std::string(text) + "\n";
}

std::string row(const std::string& name, const Samples& samples) {
  return line("  %-28s %9.2f %9.2f %9.2f", name.c_str(), samples.median(), samples.min(), samples.max());
}

void add(JsonWriter& writer, std::string_view name, const Samples& samples) {
  writer.key(name).begin_object();
  writer.member("median_ms", samples.median())
      .member("min_ms", samples.min())
      .member("max_ms", samples.max());
  writer.end_object();
}

void add(JsonWriter& writer, const Measurement& m) {
  writer.begin_object();
  writer.member("cloud", m.cloud).member("points_in", m.points_in).member("points_used", m.points_used);
  writer.member("candidates", m.num_candidates).member("handles", m.num_handles);
  add(writer, "detect", m.detect);
  writer.key("stages").begin_object();
  for (const auto& [name, samples] : m.stages) add(writer, name, samples);
  writer.end_object();
  add(writer, "surfaces", m.surfaces);
  add(writer, "pcl", m.pcl);
  add(writer, "pcl_normals", m.pcl_normals);
  add(writer, "pcl_region_growing", m.pcl_region_growing);
  writer.member("pcl_to_detect", m.pcl.median() / m.detect.median());
  writer.member("pcl_to_surfaces", m.pcl.median() / m.surfaces.median());
  writer.end_object();
}

}  // namespace

std::string table(const Measurement& m, const BenchSettings& settings) {
  std::string text =
      line("%s: %zu points, %d after downsampling; %d candidates, %zu handles; %d rounds, %d threads",
           m.cloud.c_str(), m.points_in, m.points_used, m.num_candidates, m.num_handles, settings.rounds,
           settings.threads);
  text += line("  leaf %.1f mm, radius %.1f mm",
               1e3 * static_cast<double>(settings.config.downsample.leaf_size_m),
               1e3 * static_cast<double>(settings.config.neighborhoods.radius_m));
  text += line("  %-28s %9s %9s %9s", "[ms]", "median", "min", "max");
  for (const auto& [name, samples] : m.stages) text += row("  " + name, samples);
  text += row("graspd, cloud to handles", m.detect);
  text += row("graspd, surfaces alone", m.surfaces);
  text += row("  normals", m.pcl_normals) + row("  region growing", m.pcl_region_growing);
  text += row("PCL, surfaces alone", m.pcl);
  text += line("  PCL takes %.1f times as long as graspd's whole way, %.1f times as long as its surfaces",
               m.pcl.median() / m.detect.median(), m.pcl.median() / m.surfaces.median());
  return text;
}

std::string summary(const std::vector<Measurement>& measurements) {
  Samples detect, surfaces, pcl, points;
  for (const Measurement& m : measurements) {
    detect.ms.push_back(m.detect.median());
    surfaces.ms.push_back(m.surfaces.median());
    pcl.ms.push_back(m.pcl.median());
    points.ms.push_back(static_cast<double>(m.points_in));
  }
  return line(
      "%zu clouds, median %.0f points: graspd %.2f ms (%.2f to %.2f), its surfaces %.2f ms, PCL's %.2f ms",
      measurements.size(), points.median(), detect.median(), detect.min(), detect.max(), surfaces.median(),
      pcl.median());
}

std::string json(const std::vector<Measurement>& measurements, const BenchSettings& settings) {
  JsonWriter writer;
  writer.begin_object();
  writer.member("threads", settings.threads).member("rounds", settings.rounds);
  writer.member("leaf_size_m", settings.config.downsample.leaf_size_m);
  writer.member("radius_m", settings.config.neighborhoods.radius_m);
  writer.key("clouds").begin_array();
  for (const Measurement& m : measurements) add(writer, m);
  writer.end_array().end_object();
  return writer.str() + "\n";
}

}  // namespace graspd
