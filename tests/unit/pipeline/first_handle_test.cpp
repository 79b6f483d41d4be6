// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/first_handle.hpp"

#include <gtest/gtest.h>

#include <memory_resource>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/detections.hpp"

namespace graspd {
namespace {

/// What the search finds in a cloud, and the first handles among it.
class Search {
 public:
  explicit Search(const PointCloud& cloud)
      : kept_(filter_workspace(cloud, {})),
        depth_map_(kept_.cloud, kept_.pixels),
        surfaces_(find_surfaces(kept_.cloud, {}, [](std::string_view) {})),
        far_sides_(find_far_sides(surfaces_, depth_map_)),
        search_({kept_.cloud, depth_map_, surfaces_, far_sides_}, surfaces_.objects, gripper_, config_) {
    result_.segments.resize(surfaces_.segments.list.size());
    search_.run(std::pmr::vector<std::uint8_t>(surfaces_.segments.list.size(), 1), buffers_, result_);
    first_ = first_among(result_.handles);
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  [[nodiscard]] const std::pmr::vector<FoundHandle>& found() const { return result_.handles; }
  [[nodiscard]] const std::pmr::vector<FoundHandle>& first() const { return first_; }
  [[nodiscard]] std::pmr::vector<FoundHandle> first_among(const std::pmr::vector<FoundHandle>& found) {
    return first_handles(found, surfaces_, gripper_, config_.check, buffers_);
  }
  [[nodiscard]] Failure check_again(const FoundHandle& found) const {
    CheckBuffers buffers;
    return check_candidate(*found.scene, gripper_, config_.check, found.as_candidate(), buffers).failure;
  }

 private:
  Gripper gripper_;
  DetectConfig config_;
  WorkspaceResult kept_;
  DepthMap depth_map_;
  Surfaces surfaces_;
  FarSides far_sides_;
  GuessSearch search_;
  CheckBuffersOfThreads buffers_;
  SearchResult result_;
  std::pmr::vector<FoundHandle> first_;
};

PointCloud long_box() {
  return render(on_table({standing_box(0, 0, {0.20, 0.05, 0.06})})).cloud;
}

TEST(GuessSearch, PlacesFarApartHaveTheirTurns) {
  const Search search(long_box());
  constexpr float kLength = 0.20f;
  float low = kLength, high = -kLength;
  for (const FoundHandle& found : search.found()) {
    low = std::min(low, found.ranked.handle.position.x());
    high = std::max(high, found.ranked.handle.position.x());
  }
  EXPECT_GT(high - low, 0.5f * kLength);
}

TEST(GuessSearch, OffTheMiddleIsWhereWeightTurnsTheObjectAboutTheClosingAxis) {
  Support table;
  table.plane = {Eigen::Vector3f::UnitZ(), 0};
  const auto central = [](const Eigen::Vector3f& closing, const Eigen::Vector3f& approach,
                          const Eigen::Vector3f& from_pads, const std::optional<Support>& support) {
    constexpr float kPadMiddle = 0.015f;
    Handle handle;
    handle.rotation << closing.cross(approach), closing, approach;
    return centrality(handle, kPadMiddle * approach + from_pads, support);
  };
  const Eigen::Vector3f x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY(),
                        z = Eigen::Vector3f::UnitZ();
  constexpr float kLittle = 0.03f, kOff = 0.07f;
  const float less = std::exp(-1.0f), tolerance = 1e-5f;
  EXPECT_EQ(central(y, -z, 0.99f * kLittle * x, table), 1) << "what is seen may be a part only";
  EXPECT_NEAR(central(y, -z, kOff * x, table), less, tolerance) << "from above";
  EXPECT_NEAR(central(y, -z, kOff * y - 0.2f * z, table), 1, tolerance);
  EXPECT_NEAR(central(x, y, kOff * y, table), less, tolerance) << "from the side";
  EXPECT_NEAR(central(x, y, kOff * x - 0.2f * z, table), 1, tolerance) << "the neck of a bottle";
  EXPECT_NEAR(central(z, y, kOff * y, table), 1, tolerance) << "between jaws above each other";
  EXPECT_NEAR(central(x, y, kOff * z, std::nullopt), less, tolerance) << "where is up is not known";
}

TEST(FirstHandle, NothingFoundNothingFirst) {
  CheckBuffersOfThreads buffers;
  EXPECT_TRUE(first_handles({}, {}, {}, {}, buffers).empty());
}

TEST(FirstHandle, OneForEachObjectThatHasHandles) {
  const Search search(render(three_objects()).cloud);
  std::set<int> objects;
  for (const FoundHandle& found : search.found()) objects.insert(found.ranked.object);
  ASSERT_EQ(objects.size(), 3u);
  ASSERT_EQ(search.first().size(), objects.size());
  auto object = objects.begin();
  for (const FoundHandle& first : search.first()) {
    EXPECT_TRUE(first.ranked.is_first);
    EXPECT_EQ(first.ranked.object, *object++);
    EXPECT_EQ(search.check_again(first), Failure::kNone);
    EXPECT_EQ(first.ranked.handle.score, score(first.margins));
    EXPECT_GT(first.ranked.handle.score, 0.5f);
  }
}

TEST(FirstHandle, TakesALongBoxInTheMiddle) {
  const Search search(long_box());
  ASSERT_EQ(search.first().size(), 1u);
  const Handle& first = search.first()[0].ranked.handle;
  EXPECT_NEAR(std::abs(first.rotation(0, 0)), 1, 0.02f) << "the major axis is the box's";
  EXPECT_NEAR(first.position.x(), 0, 0.004f);
}

TEST(FirstHandle, TakesALongBoxWithoutASupportInTheMiddle) {
  AnalyticScene scene = on_table({standing_box(0, 0, {0.20, 0.05, 0.06})});
  scene.solids.erase(scene.solids.begin());
  const Search search(render(scene).cloud);
  ASSERT_EQ(search.first().size(), 1u);
  EXPECT_NEAR(search.first()[0].ranked.handle.position.x(), 0, 0.004f);
}

/// The edge of a thin wall is not moved to the middle, so that it must be chosen there.
TEST(FirstHandle, NearTheMiddleRatherThanTheOneThatScoresALittleMore) {
  constexpr float kLittleMore = 0.02f;
  Search search(render(on_table({standing_box(0, 0, {0.22, 0.004, 0.06})})).cloud);
  std::pmr::vector<FoundHandle> two;
  for (const bool at_end : {true, false}) {
    const auto it = std::ranges::find_if(search.found(), [&](const FoundHandle& found) {
      const float off = std::abs(found.ranked.handle.position.x());
      return found.candidate.is_on_known_wall() && (at_end ? off > 0.07f : off < 0.04f);
    });
    ASSERT_NE(it, search.found().end());
    two.push_back(*it);
  }
  two[0].ranked.handle.score = two[1].ranked.handle.score + kLittleMore;
  const std::pmr::vector<FoundHandle> first = search.first_among(two);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_LT(std::abs(first[0].ranked.handle.position.x()), 0.04f);
}

/// Over a few noisy frames of the same scene: no seed of the noise is special.
TEST(FirstHandle, StaysWhereItIsInNoise) {
  for (const PointCloud& cloud : {long_box(), render(cylinder_on_table()).cloud}) {
    const Search still(cloud);
    ASSERT_EQ(still.first().size(), 1u);
    std::pmr::vector<float> distances, angles;
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      const Search noisy(with_range_noise(cloud, 0.001f, seed));
      ASSERT_EQ(noisy.first().size(), 1u);
      const GripDifference move = difference(still.first()[0].ranked.handle, noisy.first()[0].ranked.handle);
      distances.push_back(move.distance_m);
      angles.push_back(move.angle_deg);
    }
    std::sort(distances.begin(), distances.end());
    std::sort(angles.begin(), angles.end());
    EXPECT_LT(distances[2], 0.005f);
    EXPECT_LT(angles[2], 5.0f);
  }
}

}  // namespace
}  // namespace graspd
