// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Valid random messages of every type, and ways to spoil them.
#pragma once
#include <cstddef>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "graspd/control_t.hpp"
#include "graspd/depth_image_t.hpp"
#include "graspd/handle_list_t.hpp"
#include "graspd/point_cloud_t.hpp"
#include "graspd/segmentation_request_t.hpp"
#include "graspd/segmentation_t.hpp"
#include "graspd/status_t.hpp"

namespace graspd {

using Bytes = std::vector<std::byte>;
using Random = std::mt19937_64;

[[nodiscard]] int random_int(Random& random, int min, int max);
[[nodiscard]] double random_double(Random& random);
[[nodiscard]] std::string random_text(Random& random);

/// Organized or not, sometimes empty, with other fields before, between and behind x, y and z in any order,
/// with gaps; coordinates are any bits, NaN and infinity among them.
[[nodiscard]] point_cloud_t random_point_cloud(Random& random, int max_side);
[[nodiscard]] depth_image_t random_depth_image(Random& random, int max_side);
[[nodiscard]] handle_list_t random_handle_list(Random& random);
[[nodiscard]] status_t random_status(Random& random);
[[nodiscard]] control_t random_control(Random& random);
[[nodiscard]] segmentation_t random_segmentation(Random& random);
[[nodiscard]] segmentation_request_t random_segmentation_request(Random& random);

/// One point, to be spoilt.
[[nodiscard]] point_cloud_t small_point_cloud();
/// Two pixels, to be spoilt.
[[nodiscard]] depth_image_t small_depth_image();

/// By lcm-gen's own code, without a look at the counts.
template <class Message>
[[nodiscard]] Bytes raw_bytes(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(size));
  return bytes;
}

/// lcm-gen's decoder: the oracle on valid messages.
template <class Message>
[[nodiscard]] Message generated_decode(const Bytes& bytes) {
  Message message;
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size()))
    std::abort();
  return message;
}

/// Calls back with every proper beginning of the message, each in memory of just that size.
void for_each_truncation(const Bytes& message, const std::function<void(const Bytes&)>& visit);
/// Calls back with every message that differs in one byte.
void for_each_corruption(const Bytes& message, const std::function<void(const Bytes&)>& visit);
/// Overwrites with a big-endian number.
void put(Bytes& message, std::size_t offset, std::int64_t value, std::size_t size);

}  // namespace graspd
