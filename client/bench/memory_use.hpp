// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How much memory something needs at its peak.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace graspd {

/// By how much the resident memory of this process rises above where it was while the body runs [bytes], with
/// free memory given back to the kernel before and nothing kept for it by std::pmr's default resource. The
/// body leaves no container of std::pmr behind. Nothing where the kernel does not tell.
[[nodiscard]] std::optional<std::int64_t> peak_growth_bytes(const std::function<void()>& body);

/// A value of /proc/PROCESS/status [bytes]; process: a number, or "self". key: with its colon. Nothing where
/// it is not told.
[[nodiscard]] std::optional<std::int64_t> status_bytes(const std::string& process, const std::string& key);

}  // namespace graspd
