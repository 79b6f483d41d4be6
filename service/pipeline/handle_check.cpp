// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_check.hpp"

namespace graspd {

std::string_view name(Failure failure) {
  constexpr std::array<std::string_view, kNumFailures + 1> kNames{
      "too_few_points", "too_wide", "no_gap", "fingers", "palm", "way", "support", "silhouettes", "walls", "contact", "unseen", "none"};
  return kNames[static_cast<std::size_t>(failure)];
}

}  // namespace graspd
