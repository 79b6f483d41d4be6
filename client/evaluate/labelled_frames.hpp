// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Labelled frames from cloud files, folders of them, and LCM event logs, one after the other.
#pragma once
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "client/common/cloud_file.hpp"
#include "service/pipeline/handle.hpp"

namespace graspd {

struct LabelledFrame {
  std::string name;                 ///< the file's without folder and ending; LOG#SEQ
  std::optional<std::int64_t> seq;  ///< of frames in logs
  LabelledCloud cloud;
  /// What was answered to the frame, where its log has a handle list for it: in the list's frame.
  std::optional<std::pmr::vector<Handle>> logged_handles;
};

/// Calls visit for each frame in the order of the arguments; it returns false to stop. What cannot be used is
/// said in one line each to problem, and the rest goes on. Throws CloudFileError and EventLogError for
/// arguments that do not exist.
void for_each_frame(const std::vector<std::string>& arguments,
                    const std::function<bool(LabelledFrame&)>& visit,
                    const std::function<void(const std::string&)>& problem);

}  // namespace graspd
