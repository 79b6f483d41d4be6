// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The whole way of a message: decode, detect_handles, encode.
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "service/pipeline/detect_handles.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/fuzzer.hpp"

namespace graspd {
namespace {

/// Few points reach every stage when no surface is too small for it.
DetectConfig config_for_few_points() {
  DetectConfig config;
  config.segments.min_area_m2 = 0;
  config.support.min_area_m2 = 0.001f;
  config.support.hypotheses = 10;
  config.objects.min_border_pairs = 1;
  config.check.min_contact_area_m2 = 0;
  config.search.all_directions = 2;
  config.search.seed_spacing_m = 0.05f;
  return config;
}

DecodeLimits limits_for_few_points() {
  DecodeLimits limits;
  limits.max_points = 256;
  return limits;
}

void check_detection(const Detection& detection, const PointCloud& cloud) {
  require(detection.points_in == static_cast<int>(cloud.size()) &&
          detection.points_used <= detection.points_in);
  require((detection.status == DetectionStatus::kOk) == !detection.handles.empty());
  for (const Handle& handle : detection.handles) {
    require(handle.position.allFinite() && handle.rotation.allFinite());
    require(handle.score >= 0 && handle.score <= 1 && handle.width_m >= 0 && std::isfinite(handle.width_m));
  }
}

}  // namespace
}  // namespace graspd

/// The first byte chooses the message's type and the settings.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  if (size == 0) return 0;
  const bool image = (data[0] & 1) != 0;
  const auto message =
      message_of(image ? kDepthImageFingerprint : kPointCloudFingerprint, data + 1, size - 1);
  const auto decoded = decode_cloud(message, limits_for_few_points());
  const auto* frame = std::get_if<Frame>(&decoded);
  if (frame == nullptr) return 0;
  const DetectConfig config = (data[0] & 2) != 0 ? DetectConfig{} : config_for_few_points();
  const Detection detection = detect_handles(frame->cloud, Gripper{}, config);
  check_detection(detection, frame->cloud);
  HandleListHeader header;
  header.utime = frame->utime;
  header.seq = frame->seq;
  header.frame_name = frame->frame_name;
  header.status = wire_status(detection.status);
  const auto list = encode(make_handle_list(header, Gripper{}, detection, Eigen::Isometry3f::Identity()));
  require(decode_handle_list(list).has_value());
  return 0;
}
