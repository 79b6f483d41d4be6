// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "client/compare/distribution.hpp"
#include "client/compare/report.hpp"

namespace graspd {
namespace {

Distribution of(std::initializer_list<double> values) {
  Distribution d(0.5);
  for (const double value : values) d.add(value);
  return d;
}

handle_t handle_at(double x, double score) {
  handle_t handle{};
  handle.position[0] = x;
  handle.approach[2] = 1;
  handle.closing_axis[1] = 1;
  handle.score = score;
  return handle;
}

handle_list_t list_of(std::initializer_list<handle_t> handles) {
  handle_list_t list{};
  list.handles = handles;
  list.num_handles = static_cast<std::int32_t>(handles.size());
  list.status = handles.size() > 0 ? handle_list_t::OK : handle_list_t::NO_HANDLES;
  return list;
}

TEST(Distribution, SaysWhatItsValuesAreLike) {
  const Distribution d = of({1, 2, 3, 4, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(d.count(), 4);
  EXPECT_DOUBLE_EQ(d.mean(), 2.5);
  EXPECT_DOUBLE_EQ(d.quantile(0.5), 2);
  EXPECT_DOUBLE_EQ(d.quantile(1), 4);
  EXPECT_EQ(of({}).mean(), 0);
  EXPECT_EQ(of({}).quantile(0.5), 0);
}

TEST(Distribution, ShiftIsTheLargestDifferenceOfTheTwoFunctions) {
  EXPECT_DOUBLE_EQ(shift_between(of({1, 2, 3}), of({3, 2, 1})), 0);
  EXPECT_DOUBLE_EQ(shift_between(of({1, 2}), of({8, 9})), 1);
  EXPECT_DOUBLE_EQ(shift_between(of({1, 2, 3, 4}), of({3, 4, 5, 6})), 0.5);
  EXPECT_DOUBLE_EQ(shift_between(of({1}), of({})), 0);
}

TEST(FrameDifference, CountsHandlesWithoutCounterpart) {
  const auto before = list_of({handle_at(0, 0.9), handle_at(0.1, 0.8), handle_at(0.2, 0.7)});
  handle_t mirrored = handle_at(0.11, 0.6);
  mirrored.closing_axis[1] = -1;
  const FrameDifference d = difference(before, list_of({mirrored, handle_at(0.5, 0.5)}));
  EXPECT_EQ(d.lost, 2);
  EXPECT_EQ(d.gained, 1);
  EXPECT_NEAR(d.net_loss(), 0.9 - 0.6 + 0.5 * 2 / 3 - 0.5 * 1 / 2, 1e-12);
  EXPECT_NEAR(difference(before, before).net_loss(), 0, 1e-12);
  EXPECT_NEAR(difference(before, list_of({})).net_loss(), 0.9 + 0.5, 1e-12);
}

TEST(FrameDifference, EachHandleIsOneCounterpartAtMost) {
  const auto two = list_of({handle_at(0, 0.9), handle_at(0.005, 0.8)});
  EXPECT_EQ(difference(two, list_of({handle_at(0.001, 0.9)})).lost, 1);
  handle_t turned = handle_at(0, 0.9);
  turned.approach[2] = 0;
  turned.approach[0] = 1;
  EXPECT_EQ(difference(list_of({handle_at(0, 0.9)}), list_of({turned})).lost, 1);
}

TEST(Report, StrangersNamesAreText) {
  RunComparison comparison;
  comparison.worst.push_back({});
  comparison.worst[0].difference.key.channel = "<script>|\n";
  const ReportInput input{"a<b", "c", comparison, {}};
  for (const std::string& report : {markdown_report(input), html_report(input)}) {
    EXPECT_EQ(report.find("<script>"), std::string::npos);
    EXPECT_NE(report.find("&lt;script&gt;&#124;?"), std::string::npos);
    EXPECT_NE(report.find("a&lt;b"), std::string::npos);
  }
}

}  // namespace
}  // namespace graspd
