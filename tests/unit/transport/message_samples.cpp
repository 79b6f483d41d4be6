// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/transport/message_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace graspd {
namespace {

std::vector<std::uint8_t> random_data(Random& random, std::size_t size) {
  std::vector<std::uint8_t> data(size);
  for (auto& byte : data) byte = static_cast<std::uint8_t>(random_int(random, 0, 255));
  return data;
}

std::vector<reason_count_t> random_reasons(Random& random) {
  std::vector<reason_count_t> reasons(static_cast<std::size_t>(random_int(random, 0, 3)));
  for (auto& entry : reasons) {
    entry.reason = random_text(random);
    entry.count = random_int(random, 0, 1'000'000);
  }
  return reasons;
}

void fill(Random& random, std::span<double> values) {
  for (double& value : values) value = random_double(random);
}

handle_t random_handle(Random& random) {
  handle_t handle;
  handle.id = random_int(random, 0, 100);
  handle.segment_id = random_int(random, -1, 100);
  fill(random, handle.position);
  fill(random, handle.orientation);
  fill(random, handle.rpy);
  fill(random, handle.approach);
  fill(random, handle.closing_axis);
  fill(random, handle.major_axis);
  handle.width = random_double(random);
  fill(random, handle.gap);
  fill(random, handle.observed_free);
  handle.num_points = random_int(random, 0, 10'000);
  handle.score = random_double(random);
  return handle;
}

source_status_t random_source(Random& random) {
  source_status_t source;
  source.name = random_text(random);
  source.channel = random_text(random);
  for (auto* member : {&source.received, &source.processed, &source.failed, &source.coarse, &source.dropped,
                       &source.refused, &source.pending, &source.lost}) {
    *member = static_cast<std::int64_t>(random());
  }
  source.rate = random_double(random);
  source.age = random_double(random);
  source.degraded = static_cast<std::int8_t>(random_int(random, 0, 1));
  source.latency_p50 = random_double(random);
  source.latency_p99 = random_double(random);
  source.drops = random_reasons(random);
  source.num_drops = static_cast<std::int32_t>(source.drops.size());
  source.refusals = random_reasons(random);
  source.num_refusals = static_cast<std::int32_t>(source.refusals.size());
  source.last_error = random_text(random);
  return source;
}

segment_t random_segment(Random& random) {
  segment_t segment;
  segment.id = random_int(random, 0, 100);
  segment.object = random_int(random, -1, 100);
  segment.num_points = random_int(random, 0, 10'000);
  fill(random, segment.centroid);
  fill(random, segment.normal);
  fill(random, segment.major_axis);
  segment.num_candidates = random_int(random, 0, 1000);
  segment.num_handles = random_int(random, 0, 1000);
  segment.reason = random_text(random);
  segment.failures = random_reasons(random);
  segment.num_failures = static_cast<std::int32_t>(segment.failures.size());
  return segment;
}

/// Each behind the one before, with gaps; returns the size of a point.
std::int32_t lay_out(Random& random, std::vector<point_field_t>& fields) {
  constexpr std::int32_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  std::int32_t end = 0;
  for (auto& field : fields) {
    field.offset = end + random_int(random, 0, 3);
    end = field.offset + kSizes[field.datatype];
  }
  return end + random_int(random, 0, 5);
}

}  // namespace

int random_int(Random& random, int min, int max) {
  return std::uniform_int_distribution<int>(min, max)(random);
}
double random_double(Random& random) {
  return std::normal_distribution<double>()(random);
}

std::string random_text(Random& random) {
  std::string text(static_cast<std::size_t>(random_int(random, 0, 20)), ' ');
  for (char& c : text) c = static_cast<char>(random_int(random, ' ', '~'));
  return text;
}

point_cloud_t random_point_cloud(Random& random, int max_side) {
  point_cloud_t cloud;
  cloud.utime = static_cast<std::int64_t>(random());
  cloud.seq = static_cast<std::int64_t>(random());
  cloud.frame_name = random_text(random);
  fill(random, cloud.viewpoint);
  cloud.width = random_int(random, 0, max_side);
  cloud.height = random_int(random, 0, max_side);
  for (const char* name : {"x", "y", "z"}) cloud.fields.push_back({name, 0, point_field_t::FLOAT32, 1});
  for (int i = random_int(random, 0, 4); i > 0; --i) {
    cloud.fields.push_back(
        {"extra" + std::to_string(i), 0, static_cast<std::int8_t>(random_int(random, 1, 8)), 1});
  }
  std::shuffle(cloud.fields.begin(), cloud.fields.end(), random);
  cloud.num_fields = static_cast<std::int32_t>(cloud.fields.size());
  cloud.point_step = lay_out(random, cloud.fields);
  cloud.data_size = cloud.width * cloud.height * cloud.point_step;
  cloud.data = random_data(random, static_cast<std::size_t>(cloud.data_size));
  return cloud;
}

depth_image_t random_depth_image(Random& random, int max_side) {
  depth_image_t image;
  image.utime = static_cast<std::int64_t>(random());
  image.seq = static_cast<std::int64_t>(random());
  image.frame_name = random_text(random);
  image.depth_scale = std::exp(random_double(random)) * 1e-3;
  image.fx = 500 * std::exp(random_double(random));
  image.fy = 500 * std::exp(random_double(random));
  image.cx = 300 * random_double(random);
  image.cy = 300 * random_double(random);
  image.width = random_int(random, 0, max_side);
  image.height = random_int(random, 0, max_side);
  image.data_size = 2 * image.width * image.height;
  image.data = random_data(random, static_cast<std::size_t>(image.data_size));
  for (std::size_t i = 0; i + 1 < image.data.size(); i += 2) {
    if (random_int(random, 0, 3) == 0) image.data[i] = image.data[i + 1] = 0;
  }
  return image;
}

handle_list_t random_handle_list(Random& random) {
  handle_list_t list;
  list.utime = static_cast<std::int64_t>(random());
  list.seq = static_cast<std::int64_t>(random());
  list.source_channel = random_text(random);
  list.frame_name = random_text(random);
  list.gripper = {random_text(random), 0.1, 0.2, 0.3, 0.4, 0.5, random_double(random)};
  list.status = static_cast<std::int8_t>(random_int(random, -128, 127));
  list.status_text = random_text(random);
  list.config_revision = static_cast<std::int64_t>(random());
  list.voxel_size = random_double(random);
  list.degraded = static_cast<std::int8_t>(random_int(random, 0, 1));
  for (auto* member : {&list.points_in, &list.points_used, &list.num_segments, &list.num_candidates}) {
    *member = random_int(random, 0, 1'000'000);
  }
  list.candidate_failures = random_reasons(random);
  list.num_candidate_failures = static_cast<std::int32_t>(list.candidate_failures.size());
  list.segment_failures = random_reasons(random);
  list.num_segment_failures = static_cast<std::int32_t>(list.segment_failures.size());
  list.stages.resize(static_cast<std::size_t>(random_int(random, 0, 5)));
  for (auto& stage : list.stages) stage = {random_text(random), random_double(random)};
  list.num_stages = static_cast<std::int32_t>(list.stages.size());
  list.latency = random_double(random);
  for (int i = random_int(random, 0, 4); i > 0; --i) list.handles.push_back(random_handle(random));
  list.num_handles = static_cast<std::int32_t>(list.handles.size());
  return list;
}

status_t random_status(Random& random) {
  status_t status;
  status.utime = static_cast<std::int64_t>(random());
  status.version = random_text(random);
  status.host = random_text(random);
  status.pid = random_int(random, 1, 1 << 22);
  status.state = static_cast<std::int8_t>(random_int(random, 0, 1));
  status.uptime = random_double(random);
  status.cpu = random_double(random);
  status.rss = static_cast<std::int64_t>(random());
  status.peak_rss = static_cast<std::int64_t>(random());
  for (auto* member :
       {&status.num_threads, &status.num_descriptors, &status.num_workers, &status.num_stuck}) {
    *member = random_int(random, 0, 64);
  }
  for (auto* member :
       {&status.waiting_bytes, &status.receive_errors, &status.reassembly_errors, &status.reconnects,
        &status.log_lost, &status.ignored, &status.config_revision, &status.control_id}) {
    *member = static_cast<std::int64_t>(random());
  }
  status.config_error = random_text(random);
  status.overrides = random_text(random);
  for (int i = random_int(random, 0, 3); i > 0; --i) {
    status.errors.push_back({static_cast<std::int64_t>(random()), random_text(random), random_text(random),
                             static_cast<std::int64_t>(random())});
  }
  status.num_errors = static_cast<std::int32_t>(status.errors.size());
  for (int i = random_int(random, 0, 3); i > 0; --i) status.sources.push_back(random_source(random));
  status.num_sources = static_cast<std::int32_t>(status.sources.size());
  return status;
}

control_t random_control(Random& random) {
  control_t control;
  control.utime = static_cast<std::int64_t>(random());
  control.id = random_int(random, 1, 1 << 30);
  control.command = static_cast<std::int8_t>(random_int(random, control_t::RELOAD, control_t::RESET));
  control.text = random_text(random);
  return control;
}

segmentation_t random_segmentation(Random& random) {
  segmentation_t segmentation;
  segmentation.utime = static_cast<std::int64_t>(random());
  segmentation.seq = static_cast<std::int64_t>(random());
  segmentation.source_channel = random_text(random);
  segmentation.frame_name = random_text(random);
  segmentation.config_revision = static_cast<std::int64_t>(random());
  segmentation.voxel_size = random_double(random);
  fill(random, segmentation.origin);
  segmentation.step = random_double(random);
  fill(random, segmentation.support_plane);
  for (int i = random_int(random, 0, 3); i > 0; --i) segmentation.segments.push_back(random_segment(random));
  segmentation.num_segments = static_cast<std::int32_t>(segmentation.segments.size());
  segmentation.num_points = random_int(random, 0, 10);
  segmentation.data_size = segmentation_t::POINT_BYTES * segmentation.num_points;
  segmentation.data = random_data(random, static_cast<std::size_t>(segmentation.data_size));
  for (std::size_t i = 0; i < segmentation.data.size(); i += segmentation_t::POINT_BYTES) {
    const int segment = random_int(random, -1, segmentation.num_segments - 1);
    segmentation.data[i + 6] = segmentation.data[i + 7] = 0xff;
    if (segment < 0) continue;
    segmentation.data[i + 6] = static_cast<std::uint8_t>(segment);
    segmentation.data[i + 7] = 0;
  }
  return segmentation;
}

segmentation_request_t random_segmentation_request(Random& random) {
  segmentation_request_t request;
  request.utime = static_cast<std::int64_t>(random());
  request.source_channel = random_text(random);
  request.seconds = random_int(random, 1, 6000) / 100.0;
  return request;
}

point_cloud_t small_point_cloud() {
  point_cloud_t cloud{};
  cloud.utime = 1'000'002;
  cloud.seq = 7;
  cloud.frame_name = "camera";
  cloud.width = cloud.height = 1;
  for (const char* name : {"x", "y", "z"}) {
    cloud.fields.push_back({name, cloud.point_step, point_field_t::FLOAT32, 1});
    cloud.point_step += 4;
  }
  cloud.num_fields = 3;
  cloud.data_size = 12;
  cloud.data.resize(12);
  const float point[3] = {0.25f, -0.5f, 1.0f};
  std::memcpy(cloud.data.data(), point, sizeof(point));
  return cloud;
}

depth_image_t small_depth_image() {
  depth_image_t image{};
  image.utime = 1'000'003;
  image.seq = 8;
  image.frame_name = "depth";
  image.depth_scale = 0.001;
  image.fx = image.fy = 500;
  image.cx = 0.5;
  image.width = 2;
  image.height = 1;
  image.data_size = 4;
  image.data = {0xe8, 0x03, 0, 0};
  return image;
}

void for_each_truncation(const Bytes& message, const std::function<void(const Bytes&)>& visit) {
  for (std::size_t size = 0; size < message.size(); ++size) {
    visit(Bytes(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(size)));
  }
}

void for_each_corruption(const Bytes& message, const std::function<void(const Bytes&)>& visit) {
  Bytes corrupt = message;
  for (std::size_t i = 0; i < message.size(); ++i) {
    for (int flip = 1; flip < 256; ++flip) {
      corrupt[i] = message[i] ^ static_cast<std::byte>(flip);
      visit(corrupt);
    }
    corrupt[i] = message[i];
  }
}

void put(Bytes& message, std::size_t offset, std::int64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    message.at(offset + i) = static_cast<std::byte>((value >> (8 * (size - 1 - i))) & 0xff);
  }
}

}  // namespace graspd
