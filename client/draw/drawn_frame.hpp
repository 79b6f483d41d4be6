// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The frame to be drawn, from a cloud file or a log.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "client/draw/picture.hpp"
#include "service/config/source_config.hpp"
#include "service/transport/seal.hpp"

namespace graspd {

/// The frame with this number, from 0, of files, folders and LCM event logs one after the other. A log's own
/// handles and segments are drawn where it has them for the frame; whatever is missing is found by the method
/// with these settings, in the calling thread's oneTBB arena. The keys open what is signed in logs. What
/// cannot be used on the way there is left out and said in `problems`. Throws CloudFileError or EventLogError
/// for arguments that do not exist, std::runtime_error where there is no such frame.
[[nodiscard]] PictureFrame find_drawn_frame(const std::vector<std::string>& arguments, std::size_t number,
                                            const SourceConfig& source, std::span<const SealKey> keys,
                                            std::vector<std::string>& problems);

}  // namespace graspd
