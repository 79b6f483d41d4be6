// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A comparison for people: Markdown, and the same as a page of HTML.
#pragma once
#include <string>
#include <vector>

#include "client/compare/run_comparison.hpp"
#include "client/compare/worst_pictures.hpp"

namespace graspd {

/// Names as they were given on the command line; pictures: one for each of the worst frames, or none at all.
struct ReportInput {
  std::string before;
  std::string after;
  const RunComparison& comparison;
  std::vector<FramePictures> pictures;
};

[[nodiscard]] std::string markdown_report(const ReportInput& input);
[[nodiscard]] std::string html_report(const ReportInput& input);

}  // namespace graspd
