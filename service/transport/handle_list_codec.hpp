// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Detection -> handle_list_t -> message, and back for clients.
#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "graspd/handle_list_t.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "service/pipeline/gripper.hpp"

namespace graspd {

/// Names and times of stages, in the order of the pipeline.
using StageTimes = std::pmr::vector<std::pair<std::pmr::string, double>>;

/// What a list says besides the detection.
struct HandleListHeader {
  std::int64_t utime = 0;           ///< of the cloud [us]
  std::int64_t seq = -1;            ///< of the cloud
  std::pmr::string source_channel;  ///< that the cloud came on
  std::pmr::string frame_name;      ///< of T_target_cloud's target
  std::int8_t status = 0;           ///< one of handle_list_t's values
  std::pmr::string status_text;
  std::int64_t config_revision = 0;  ///< 0: no daemon's
  double voxel_m = 0;                ///< that the frame was worked on with
  bool degraded = false;             ///< coarser than configured
  double latency_s = 0;              ///< from arrival to publishing
  StageTimes stages_ms;
};

/// The status on the wire of a detection.
[[nodiscard]] std::int8_t wire_status(DetectionStatus status);

/// Those that happened, in the order of the checks.
[[nodiscard]] std::vector<reason_count_t> wire_failures(const FailureCounts& counts);

/// Handles keep their order, move to the target frame and are numbered from 0.
[[nodiscard]] handle_list_t make_handle_list(const HandleListHeader& header, const Gripper& gripper,
                                             const Detection& detection,
                                             const Eigen::Isometry3f& T_target_cloud);

/// A handle_list_t as it goes over the wire.
struct HandleListMessage {
  std::pmr::vector<std::byte> bytes;  ///< fingerprint first
  std::size_t latency_at = 0;         ///< where the latency stands in the bytes

  /// From arrival to publishing, which is known last.
  void set_latency(double latency_s);
};

/// The message of make_handle_list()'s list, written straight from what is given. Reuses the message's
/// memory.
void encode(const HandleListHeader& header, const Gripper& gripper, const Detection& detection,
            const Eigen::Isometry3f& T_target_cloud, HandleListMessage& message);

/// The message, fingerprint first. Throw std::invalid_argument when a num_ member is not the length of its
/// array. The second form reuses the buffer's memory.
[[nodiscard]] std::vector<std::byte> encode(const handle_list_t& list);
void encode(const handle_list_t& list, std::vector<std::byte>& buffer);

/// Nothing unless the message is a whole, valid handle_list_t. Trusts nothing in the bytes.
[[nodiscard]] std::optional<handle_list_t> decode_handle_list(std::span<const std::byte> message);

}  // namespace graspd
