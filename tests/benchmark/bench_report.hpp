// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Measurements as a table for people and as JSON for programs.
#pragma once
#include <string>
#include <vector>

#include "tests/benchmark/measure.hpp"

namespace graspd {

[[nodiscard]] std::string table(const Measurement& m, const BenchSettings& settings);
/// Medians over the clouds, one line.
[[nodiscard]] std::string summary(const std::vector<Measurement>& measurements);
[[nodiscard]] std::string json(const std::vector<Measurement>& measurements, const BenchSettings& settings);

}  // namespace graspd
