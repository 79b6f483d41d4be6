// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which part of the logs has to be read for a selection.
#pragma once
#include <string>
#include <vector>

#include "client/replay/replay.hpp"

namespace graspd {

/// How places in the logs are found.
struct PlaceOptions {
  bool scan = false;  ///< all headers are read from the start on
  std::string
      index_file;  ///< FrameIndex for frame numbers: made where there is none for these logs; empty: none
};

/// Sets what is read; the output does not change. Returns what there is to say about it, in lines. Throws
/// EventLogError, std::runtime_error.
std::vector<std::string> find_reading(ReplayConfig& config, const PlaceOptions& options);

}  // namespace graspd
