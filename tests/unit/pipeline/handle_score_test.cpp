// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The score's properties, whatever its weights are.
#include "service/pipeline/handle_score.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace graspd {
namespace {

using Margin = float HandleMargins::*;

constexpr std::array kMargins{
    &HandleMargins::width,   &HandleMargins::grip_depth, &HandleMargins::silhouettes, &HandleMargins::square,
    &HandleMargins::walls,   &HandleMargins::seen,       &HandleMargins::thickness,   &HandleMargins::area,
    &HandleMargins::central, &HandleMargins::one_face,   &HandleMargins::grip};
constexpr std::array kKinds{ContactKind::kNone,       ContactKind::kWall,     ContactKind::kFreeEdge,
                            ContactKind::kCurvedEdge, ContactKind::kFlatEdge, ContactKind::kThinEdge};

HandleMargins with(ContactKind low, ContactKind high, float margin = 1) {
  HandleMargins margins;
  margins.contact = {low, high};
  for (const Margin m : kMargins) margins.*m = margin;
  return margins;
}

HandleMargins best() {
  return with(ContactKind::kWall, ContactKind::kWall);
}

TEST(HandleScore, NothingToHoldIsWorthNothing) {
  EXPECT_LT(score({}), 0.01f) << "no contacts";
  EXPECT_LT(score(with(ContactKind::kNone, ContactKind::kNone, 0)), 0.001f);
}

TEST(HandleScore, TheBestThereCanBeIsNearOne) {
  EXPECT_GT(score(best()), 0.9f);
  EXPECT_LE(score(best()), 1.0f);
}

TEST(HandleScore, IsAShare) {
  for (const ContactKind low : kKinds)
    for (const ContactKind high : kKinds)
      for (const float margin : {-5.0f, 0.0f, 0.3f, 1.0f, 7.0f}) {
        const float s = score(with(low, high, margin));
        EXPECT_GE(s, 0.0f);
        EXPECT_LE(s, score(best()));
      }
}

TEST(HandleScore, MoreOfAnyMarginIsNeverWorse) {
  for (const float others : {0.2f, 0.6f, 1.0f})
    for (std::size_t m = 0; m < kMargins.size(); ++m) {
      SCOPED_TRACE("margin " + std::to_string(m));
      HandleMargins margins = with(ContactKind::kWall, ContactKind::kFreeEdge, others);
      float before = -1;
      for (int step = 0; step <= 20; ++step) {
        margins.*kMargins[m] = 0.05f * static_cast<float>(step);
        const float now = score(margins);
        EXPECT_GT(now, before) << "every margin counts";
        before = now;
      }
    }
}

TEST(HandleScore, MarginsEndAtZeroAndOne) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const Margin m : kMargins) {
    HandleMargins less = best(), none = best(), more = best();
    less.*m = -kInfinity;
    none.*m = 0;
    more.*m = kInfinity;
    EXPECT_EQ(score(less), score(none));
    EXPECT_EQ(score(more), score(best()));
  }
}

TEST(HandleScore, AWallThatWasSeenIsTheBestContactAndNoneTheWorst) {
  for (const ContactKind other : kKinds)
    for (const ContactKind kind : kKinds) {
      EXPECT_LE(score(with(kind, other)), score(with(ContactKind::kWall, other)));
      EXPECT_GE(score(with(kind, other)), score(with(ContactKind::kNone, other)));
    }
  for (const ContactKind kind : kKinds)
    if (kind != ContactKind::kNone) {
      EXPECT_GT(score(with(kind, ContactKind::kWall)),
                10 * score(with(ContactKind::kNone, ContactKind::kWall)))
          << "a contact is worth much more than none";
    }
}

TEST(HandleScore, BothJawsCountAlike) {
  for (const ContactKind low : kKinds)
    for (const ContactKind high : kKinds)
      EXPECT_FLOAT_EQ(score(with(low, high, 0.7f)), score(with(high, low, 0.7f)));
}

}  // namespace
}  // namespace graspd
