// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Pictures of frames whose clouds are in the logs that both runs were over.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "client/compare/run_comparison.hpp"
#include "service/config/service_config.hpp"

namespace graspd {

struct FramePictures {
  std::string before;  ///< file name in the report's folder; empty: the cloud was not found, or is none
  std::string after;
};

/// Writes PNG files into the folder; one entry for each of the worst frames. Throws EventLogError,
/// std::runtime_error.
[[nodiscard]] std::vector<FramePictures> draw_worst(const RunComparison& comparison,
                                                    const std::vector<std::filesystem::path>& clouds,
                                                    const ServiceConfig& config,
                                                    const std::filesystem::path& folder);

}  // namespace graspd
