// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Short ways to say what a message decodes to.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "service/transport/cloud_decoder.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {

inline Frame decoded(const Bytes& message, const DecodeLimits& limits = {}) {
  auto result = decode_cloud(message, limits);
  if (const auto* refusal = std::get_if<Refusal>(&result)) {
    ADD_FAILURE() << name(refusal->reason) << ": " << refusal->text;
    return {};
  }
  return std::get<Frame>(std::move(result));
}

/// Fails where the message is a frame after all, or the text is not one printable line.
inline Refusal refused(const Bytes& message, const DecodeLimits& limits = {}) {
  auto result = decode_cloud(message, limits);
  if (!std::holds_alternative<Refusal>(result)) {
    ADD_FAILURE() << "a frame of " << std::get<Frame>(result).cloud.size() << " points";
    return {};
  }
  const auto refusal = std::get<Refusal>(std::move(result));
  EXPECT_FALSE(refusal.text.empty());
  EXPECT_TRUE(
      std::all_of(refusal.text.begin(), refusal.text.end(), [](char c) { return c >= ' ' && c <= '~'; }));
  return refusal;
}

inline void expect_refusal(const Bytes& message, RefusalReason reason, const std::string& text,
                           const DecodeLimits& limits = {}) {
  const Refusal refusal = refused(message, limits);
  EXPECT_EQ(name(refusal.reason), name(reason)) << refusal.text;
  EXPECT_NE(refusal.text.find(text), std::string::npos) << refusal.text;
}

}  // namespace graspd
