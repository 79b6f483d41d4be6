// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/replay_state.hpp"

#include <gtest/gtest.h>

#include "client/common/sha256.hpp"
#include "client/replay/progress_line.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

ReplayState sample() {
  ReplayState state;
  state.input = {2, 1'234'567, 89};
  state.frames_seen = 10;
  state.frames = 9;
  state.kept = 8;
  state.handles = 70;
  state.answers = {{"OK", 6}, {"REFUSED", 3}};
  state.output_bytes = 4'000'000'000;
  state.output_events = 17;
  return state;
}

void expect_sample(const ReplayState& state) {
  EXPECT_EQ(state.input.part, 2u);
  EXPECT_EQ(state.input.offset, 1'234'567);
  EXPECT_EQ(state.input.skipped, 89);
  EXPECT_EQ(state.frames_seen, 10);
  EXPECT_EQ(state.frames, 9);
  EXPECT_EQ(state.kept, 8);
  EXPECT_EQ(state.handles, 70);
  EXPECT_EQ(state.answers, sample().answers);
  EXPECT_EQ(state.output_bytes, 4'000'000'000);
  EXPECT_EQ(state.output_events, 17);
}

TEST(ReplayState, IsReadAsItWasSaved) {
  const TempFolder folder;
  save_state(folder / "state", "me", sample());
  const auto state = load_state(folder / "state", "me");
  ASSERT_TRUE(state);
  expect_sample(*state);
  EXPECT_THROW((void)load_state(folder / "state", "another"), std::runtime_error);
  EXPECT_FALSE(load_state(folder / "none", "me"));
}

TEST(ReplayState, AReceiptIsReadAsItWasSaved) {
  const TempFolder folder;
  save_receipt(folder / "receipt", {"me", sample(), "abc"});
  const auto receipt = load_receipt(folder / "receipt");
  ASSERT_TRUE(receipt);
  expect_sample(receipt->state);
  EXPECT_EQ(receipt->sha256, "abc");
}

TEST(ReplayState, WhatIsNotWholeIsNone) {
  const TempFolder folder;
  save_state(folder / "state", "me", sample());
  const std::string text = read_bytes(folder / "state");
  for (std::size_t size = 0; size + 2 < text.size(); size += 7) {
    write_bytes(folder / "state", text.substr(0, size));
    EXPECT_FALSE(load_state(folder / "state", "me")) << size;
    EXPECT_FALSE(load_receipt(folder / "state")) << size;
  }
  for (const char* other :
       {"[]", "3", "{\"identity\": 4, \"state\": {}}", "{\"identity\": \"me\", \"state\": []}",
        "{\"identity\": \"me\", \"state\": {\"log\": \"x\"}}"}) {
    write_bytes(folder / "state", other);
    EXPECT_FALSE(load_state(folder / "state", "me")) << other;
  }
}

TEST(Sha256, IsThatOfSha256sum) {
  const TempFolder folder;
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write_bytes(folder / "large", std::string(1'000'000, 'a'));
  EXPECT_EQ(sha256_of_file(folder / "large"),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW((void)sha256_of_file(folder / "none"), std::runtime_error);
}

TEST(ProgressLine, SaysHowFarHowFastAndHowLong) {
  EXPECT_EQ(progress_text(0.5, 120, 40.25, 3661.9),
            "[============            ]  50 %, 120 frames, 40.2 frames/s, 1:01:01 left");
  EXPECT_EQ(progress_text(1.5, 1, 0, -3).substr(0, 26), "[" + std::string(24, '=') + "]");
}

}  // namespace
}  // namespace graspd
