// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "client/evaluate/evaluator.hpp"
#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

NamedRun run(const std::string& name, const std::vector<JudgedHandle>& handles) {
  return {name, {{"a", "", {2, 3}, handles}}};
}

JudgedHandle valid(int object, const Handle& handle) {
  return {handle, object, true, ""};
}

Evaluator evaluator_of(const HandleSource& source, const EvaluatorConfig& config = {}) {
  std::vector<EvaluatedRun> runs(1);
  runs[0].handles = source;
  return {runs, config};
}

LabelledFrame box_frame(const std::string& name) {
  LabelledFrame frame;
  frame.name = name;
  frame.cloud = labelled(box_on_table());
  return frame;
}

TEST(Comparison, ARunWithItselfHasNoDifferences) {
  const NamedRun one = run("a", {valid(2, on_box()), valid(3, from_above({0.2f, 0, 0.1f}, 0.04f))});
  EXPECT_TRUE(difference_table(one, one).rows.empty());
  EXPECT_TRUE(difference_table({"a", {}}, {"b", {}}).rows.empty());
}

TEST(Comparison, SaysWhatOneHasAlone) {
  const NamedRun more = run("more", {valid(2, on_box()), valid(3, from_above({0.2f, 0, 0.1f}, 0.04f))});
  const NamedRun less = run("less", {valid(2, on_box())});
  const Table table = difference_table(less, more);
  ASSERT_EQ(table.rows.size(), 2u);  // object 3, and the handle on it
  for (const auto& row : table.rows) {
    EXPECT_EQ(std::get<std::string>(row[2]), "more");
    EXPECT_EQ(std::get<std::int64_t>(row[3]), 3);
    EXPECT_EQ(row.size(), table.columns.size());
  }
}

TEST(Comparison, HalfATurnIsTheSamePlaceAndAnInvalidHandleIsNoMatch) {
  Handle turned = on_box();
  turned.rotation = turned.rotation * Eigen::AngleAxisf(std::numbers::pi_v<float>, Eigen::Vector3f::UnitZ());
  EXPECT_TRUE(difference_table(run("a", {valid(2, on_box())}), run("b", {valid(2, turned)})).rows.empty());
  const JudgedHandle invalid{on_box(), 2, false, "walls"};
  EXPECT_EQ(difference_table(run("a", {valid(2, on_box())}), run("b", {invalid})).rows.size(), 2u);
}

TEST(Evaluator, JudgesWhatTheFileSays) {
  HandleFile file;
  file.by_frame["box"] = {on_box(), from_above({0.2f, 0, 0.1f}, 0.05f)};
  EvaluatorConfig config;
  config.disturb = true;
  config.category_patterns = {{"boxes", "b*"}, {"rest", "*"}};
  config.category_of_frame = {{"other", "named"}};
  Evaluator evaluator = evaluator_of(file, config);
  evaluator.add(box_frame("box"));
  evaluator.add(box_frame("other"));
  const auto& frames = evaluator.runs().front().frames;
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].category, "boxes");
  EXPECT_EQ(frames[1].category, "named");
  EXPECT_EQ(frames[0].objects, std::vector<int>{2});
  ASSERT_EQ(frames[0].handles.size(), 2u);
  EXPECT_TRUE(frames[0].handles[0].valid);
  EXPECT_EQ(frames[0].handles[1].failure, "target");
  EXPECT_EQ(evaluator.frames_without_handles(), 1);
  EXPECT_EQ(evaluator.steadiness()[0].valid, 1);
  EXPECT_EQ(evaluator.steadiness()[0].steady, 1);
  EXPECT_EQ(steadiness_table(evaluator).rows.size(), 1u);
}

TEST(Evaluator, TakesHandlesBackToTheCloudsFrame) {
  const Eigen::Isometry3f T_base_cloud(Eigen::Translation3f(1, 2, 3) *
                                       Eigen::AngleAxisf(0.7f, Eigen::Vector3f::UnitX()));
  HandleFile file;
  file.by_frame["box"] = {transformed(on_box(), T_base_cloud)};
  EvaluatorConfig config;
  config.T_cloud_handles = T_base_cloud.inverse();
  Evaluator evaluator = evaluator_of(file, config);
  evaluator.add(box_frame("box"));
  EXPECT_TRUE(evaluator.runs()[0].frames[0].handles[0].valid);
}

TEST(Evaluator, DetectsWhereThereAreNoHandlesYetAndTakesTheLogsElse) {
  const DetectionRun detection{"graspd", {}, {}, {}};
  std::vector<EvaluatedRun> runs(2);
  runs[0].handles = LoggedOrDetected{detection};
  runs[1].handles = detection;
  Evaluator evaluator(runs, {});
  LabelledFrame frame = box_frame("box");
  evaluator.add(frame);
  frame.logged_handles = {on_box()};
  evaluator.add(frame);
  const auto& either = evaluator.runs()[0].frames;
  const auto& detected = evaluator.runs()[1].frames;
  EXPECT_GT(detected[0].handles.size(), 0u);
  EXPECT_EQ(either[0].handles.size(), detected[0].handles.size());
  EXPECT_EQ(either[1].handles.size(), 1u);
  EXPECT_EQ(detected[1].handles.size(), detected[0].handles.size());
}

TEST(Evaluator, OnlyGraspableObjectsCount) {
  EvaluatorConfig config;
  config.graspable = {{"box", {7}}};
  Evaluator evaluator = evaluator_of(HandleFile{}, config);
  evaluator.add(box_frame("box"));
  evaluator.add(box_frame("other"));
  EXPECT_EQ(evaluator.runs()[0].frames[0].objects, std::vector<int>{7});
  EXPECT_TRUE(evaluator.runs()[0].frames[1].objects.empty());
  EXPECT_EQ(evaluator.frames_without_graspable(), 1);
}

TEST(Evaluator, SmallObjectsDoNotCount) {
  EvaluatorConfig config;
  config.min_points = 1'000'000;
  Evaluator evaluator = evaluator_of(HandleFile{}, config);
  evaluator.add(box_frame("box"));
  EXPECT_TRUE(evaluator.runs()[0].frames[0].objects.empty());
}

}  // namespace
}  // namespace graspd
