// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/bench_report.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <thread>

#include "client/common/json_writer.hpp"
#include "client/common/text.hpp"
#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

constexpr std::array<std::pair<const char*, double>, 6> kSpread{
    {{"median", 0.5}, {"min", 0}, {"q1", 0.25}, {"q3", 0.75}, {"p99", 0.99}, {"max", 1}}};

std::string heading(const BenchResult& result) {
  std::string text = result.suite + ": " + plain_line(result.name);
  if (result.points_in > 0) text += printed(", %zu points", result.points_in);
  if (result.points_used > 0) text += printed(", %d voxels", result.points_used);
  if (result.threads > 0) text += printed(", %d thread%s", result.threads, result.threads == 1 ? "" : "s");
  return text + "\n";
}

void add(JsonWriter& json, const BenchResult& result) {
  json.begin_object();
  json.member("suite", result.suite).member("name", result.name).member("threads", result.threads);
  json.member("points_in", result.points_in).member("points_used", result.points_used);
  json.key("times_ms").begin_object();
  for (const auto& [name, samples] : result.times) {
    json.key(name).begin_object().member("rounds", samples.values.size());
    for (const auto& [key, share] : kSpread) json.member(key, samples.quantile(share));
    json.end_object();
  }
  json.end_object().key("figures").begin_object();
  for (const auto& [name, value] : result.figures) json.member(name, value);
  json.end_object().end_object();
}

}  // namespace

std::string result_table(const BenchResult& result) {
  TextTable table({"  [ms]", "median", "min", "q1", "q3", "p99", "max"});
  for (const auto& [name, samples] : result.times) {
    std::vector<std::string> row{"  " + name};
    for (const auto& [key, share] : kSpread) row.push_back(printed("%.2f", samples.quantile(share)));
    table.add(row);
  }
  std::string figures;
  for (const auto& [name, value] : result.figures)
    figures +=
        (figures.empty() ? "  " : ", ") + printed("%s %.10g", name.c_str(), std::round(1e3 * value) * 1e-3);
  return heading(result) + table.str() + figures + "\n\n";
}

std::string bench_json(const BenchRun& run, const BenchOptions& options) {
  JsonWriter json;
  json.begin_object();
  json.member("cores", std::thread::hardware_concurrency());
  json.member("kernels", avx2_kernels() ? "avx2" : "portable");
  json.member("rounds", options.rounds).member("pcl_rounds", options.no_pcl ? 0 : options.pcl_rounds);
  json.member("scene", options.inputs.empty() ? options.scene : "files").member("seed", options.seed);
  json.key("results").begin_array();
  for (const BenchResult& result : run.results) add(json, result);
  json.end_array().key("skipped").begin_array();
  for (const auto& [suite, reason] : run.skipped)
    json.begin_object().member("suite", suite).member("reason", reason).end_object();
  json.end_array().end_object();
  return json.str() + "\n";
}

Plot cost_plot(const BenchRun& run) {
  Plot plot{"Time for one cloud", "points", "milliseconds (median)", {}};
  const std::array<std::pair<std::string_view, const char*>, 4> series{{{kPcl, "PCL, surfaces"},
                                                                        {kWhole, "graspd, whole"},
                                                                        {kPlain, "graspd, plain"},
                                                                        {kSurfaces, "graspd, surfaces"}}};
  constexpr std::array kColors{2, 0, 3, 1};
  for (std::size_t s = 0; s < series.size(); ++s)
    for (const BenchResult& result : run.results) {
      const Samples* samples = result.suite == "points" ? result.find(series[s].first) : nullptr;
      if (!samples) continue;
      const std::string label =
          printed("%s, %d thread%s", series[s].second, result.threads, result.threads == 1 ? "" : "s");
      auto it = std::find_if(plot.lines.begin(), plot.lines.end(),
                             [&](const PlotLine& line) { return line.label == label; });
      if (it == plot.lines.end()) it = plot.lines.insert(it, {label, kColors[s], result.threads == 1, {}});
      it->points.emplace_back(static_cast<double>(result.points_in), samples->median());
    }
  return plot;
}

}  // namespace graspd
