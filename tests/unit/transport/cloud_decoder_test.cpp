// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/cloud_decoder.hpp"

#include <gtest/gtest.h>

#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/cloud_expectations.hpp"

namespace graspd {
namespace {

std::vector<Bytes> small_messages() {
  return {raw_bytes(small_point_cloud()), raw_bytes(small_depth_image())};
}

TEST(CloudDecoder, TellsTypesByTheirFingerprint) {
  EXPECT_EQ(decoded(small_messages()[0]).frame_name, "camera");
  EXPECT_EQ(decoded(small_messages()[1]).frame_name, "depth");
}

TEST(CloudDecoder, RefusesOtherTypes) {
  Random random(1);
  using enum RefusalReason;
  expect_refusal(raw_bytes(random_handle_list(random)), kUnknownType,
                 "not a cloud (got handle_list_t, expected");
  expect_refusal(raw_bytes(random_status(random)), kUnknownType, "got status_t");
  expect_refusal(Bytes(8), kUnknownType, "got 0x0000000000000000, expected point_cloud_t 0x19d75af77ba18842");
  expect_refusal(Bytes(7), kTruncated, "fingerprint: the message ends (got 7 bytes");
  expect_refusal({}, kTruncated, "got 0 bytes");
}

TEST(CloudDecoder, RefusesEveryTruncation) {
  for (const Bytes& message : small_messages()) {
    for_each_truncation(message, [](const Bytes& part) {
      EXPECT_EQ(name(refused(part).reason), name(RefusalReason::kTruncated)) << part.size();
    });
  }
}

TEST(CloudDecoder, RefusesTrailingBytes) {
  for (Bytes message : small_messages()) {
    message.push_back({});
    expect_refusal(message, RefusalReason::kTrailingBytes, "data: the message goes on");
    EXPECT_EQ(refused(message).utime / 10, 100'000);
  }
}

TEST(CloudDecoder, DecodesOrRefusesEveryCorruption) {
  forget_allocations();
  for (const Bytes& message : small_messages()) {
    for_each_corruption(message, [](const Bytes& corrupt) {
      const auto result = decode_cloud(corrupt, {});
      if (const auto* frame = std::get_if<Frame>(&result)) {
        ASSERT_LE(frame->cloud.size(), 2u);
      } else {
        ASSERT_FALSE(std::get<Refusal>(result).text.empty());
      }
      (void)peek_header(corrupt, {});
    });
  }
  EXPECT_LT(largest_allocation(), 100'000u);
}

TEST(CloudDecoder, DecodesOrRefusesRandomBytesBehindAFingerprint) {
  Random random(5);
  for (const Bytes& message : small_messages()) {
    for (int i = 0; i < 20'000; ++i) {
      Bytes noise = message;
      noise.resize(static_cast<std::size_t>(random_int(random, 8, 200)));
      for (std::size_t k = 8; k < noise.size(); ++k) {
        if (random_int(random, 0, 2) == 0) noise[k] = static_cast<std::byte>(random_int(random, 0, 255));
      }
      (void)decode_cloud(noise, {});
    }
  }
}

TEST(CloudDecoder, RefusesNamesThatAreNoText) {
  const std::size_t length_offset = 8 + 16;
  for (const Bytes& message : small_messages()) {
    Bytes bad = message;
    bad[length_offset + 4] = std::byte{'\n'};
    expect_refusal(bad, RefusalReason::kBadString, "frame_name at byte 24");
    EXPECT_EQ(refused(bad).frame_name, "");
    bad[length_offset + 4] = std::byte{0};
    expect_refusal(bad, RefusalReason::kBadString, "frame_name");
    for (const std::int32_t length :
         {std::numeric_limits<std::int32_t>::min(), -1, 0, 257, std::numeric_limits<std::int32_t>::max()}) {
      bad = message;
      put(bad, length_offset, length, 4);
      expect_refusal(bad, RefusalReason::kBadSize, "frame_name at byte 24: impossible length");
    }
  }
}

TEST(CloudDecoder, RefusalsCarryTheHeaderAsFarAsItWentWell) {
  for (const Bytes& message : small_messages()) {
    const Frame frame = decoded(message);
    for_each_truncation(message, [&](const Bytes& part) {
      const Refusal refusal = refused(part);
      EXPECT_EQ(refusal.utime, part.size() >= 16 ? frame.utime : 0);
      EXPECT_EQ(refusal.seq, part.size() >= 24 ? frame.seq : -1);
      EXPECT_EQ(refusal.frame_name, part.size() >= 28 + frame.frame_name.size() + 1 ? frame.frame_name : "");
      const FrameHeader header = peek_header(part, {});
      EXPECT_EQ(header.utime, refusal.utime);
      EXPECT_EQ(header.seq, refusal.seq);
      EXPECT_EQ(header.frame_name, refusal.frame_name);
    });
  }
}

TEST(CloudDecoder, ChecksWhatDecodingWouldRefuse) {
  const auto same = [](const Bytes& message) {
    const auto decoded = decode_cloud(message, {});
    const auto* refusal = std::get_if<Refusal>(&decoded);
    const std::optional<Refusal> checked = check_cloud(message, {});
    ASSERT_EQ(checked.has_value(), refusal != nullptr);
    if (refusal == nullptr) return;
    EXPECT_EQ(checked->reason, refusal->reason);
    EXPECT_EQ(checked->text, refusal->text);
    EXPECT_EQ(checked->seq, refusal->seq);
    EXPECT_EQ(checked->frame_name, refusal->frame_name);
  };
  for (const Bytes& message : small_messages()) {
    same(message);
    for_each_truncation(message, same);
    for_each_corruption(message, same);
  }
}

TEST(CloudDecoder, PeeksAtTheHeaderOfCloudsAlone) {
  EXPECT_EQ(peek_header(small_messages()[0], {}).frame_name, "camera");
  EXPECT_EQ(peek_header(small_messages()[1], {}).seq, 8);
  Random random(1);
  EXPECT_EQ(peek_header(raw_bytes(random_status(random)), {}).utime, 0);
  EXPECT_EQ(peek_header({}, {}).seq, -1);
}

}  // namespace
}  // namespace graspd
