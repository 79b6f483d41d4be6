// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/segment_report.hpp"

#include <gtest/gtest.h>

#include "service/pipeline/detect_handles.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

TEST(SegmentReport, TheReasonIsTheLastCheckThatWasReached) {
  SegmentReport report;
  EXPECT_EQ(report.reason(), Failure::kTooFewPoints) << "no candidate at all";
  report.failures[static_cast<std::size_t>(Failure::kTooWide)] = 10;
  EXPECT_EQ(report.reason(), Failure::kTooWide);
  report.failures[static_cast<std::size_t>(Failure::kWalls)] = 1;
  EXPECT_EQ(report.reason(), Failure::kWalls);
  report.num_handles = 1;
  EXPECT_EQ(report.reason(), Failure::kNone);
}

TEST(SegmentReport, SegmentsOfADetectionAddUp) {
  const Detection detection = detect_handles(render(three_objects()).cloud, {}, {});
  ASSERT_FALSE(detection.segments.empty());
  int candidates = 0, handles = 0;
  FailureCounts failures{};
  for (const SegmentReport& segment : detection.segments) {
    EXPECT_GT(segment.num_points, 0);
    EXPECT_TRUE(segment.centroid.allFinite());
    int failed = 0;
    for (std::size_t i = 0; i < kNumFailures; ++i) {
      failures[i] += segment.failures[i];
      failed += segment.failures[i];
    }
    EXPECT_EQ(failed + segment.num_handles, segment.num_candidates);
    candidates += segment.num_candidates;
    handles += segment.num_handles;
  }
  EXPECT_EQ(candidates, detection.num_candidates);
  EXPECT_EQ(failures, detection.candidate_failures);
  EXPECT_GE(handles, static_cast<int>(detection.handles.size()));
  for (const Handle& handle : detection.handles) {
    ASSERT_GE(handle.segment, 0);
    ASSERT_LT(handle.segment, static_cast<int>(detection.segments.size()));
    EXPECT_GT(detection.segments[static_cast<std::size_t>(handle.segment)].num_handles, 0);
  }
}

TEST(SegmentReport, SegmentsWithoutAHandleAreCountedByTheirReason) {
  const Detection detection = detect_handles(render(too_wide_box()).cloud, {}, {});
  int counted = 0;
  for (const int n : detection.segment_failures()) counted += n;
  EXPECT_EQ(counted, static_cast<int>(detection.segments.size()));
}

}  // namespace
}  // namespace graspd
