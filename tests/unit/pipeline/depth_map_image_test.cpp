// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The depth map of an organized cloud in the optical frame, which is the cloud's own image.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "service/pipeline/depth_map.hpp"
#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr float kMargin = 0.005f;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// In the camera's optical frame.
AnalyticScene seen_scene() {
  const AnalyticScene scene = three_objects();
  return moved(scene, scene.camera.T_scene_camera.inverse());
}

/// What is left of an image when every step-th row and column stays.
PointCloud thinned(const PointCloud& image, int step_u, int step_v) {
  PointCloud part;
  for (int v = 0; v < image.height; v += step_v)
    for (int u = 0; u < image.width; u += step_u)
      part.push_back(image.point(static_cast<std::size_t>(v * image.width + u)));
  part.width = (image.width + step_u - 1) / step_u;
  part.height = (image.height + step_v - 1) / step_v;
  part.viewpoint = image.viewpoint;
  return part;
}

void make_missing(PointCloud& cloud, std::size_t i) {
  cloud.x[i] = cloud.y[i] = cloud.z[i] = kNan;
}

/// Places before, on and behind the surfaces.
template <class Visit>
void for_each_probe(const Visit& visit) {
  for (float x = -0.25f; x < 0.25f; x += 0.007f)
    for (float y = -0.2f; y < 0.2f; y += 0.007f)
      for (const float z : {0.5f, 0.6f, 0.65f, 0.7f, 0.75f, 0.8f, 0.9f}) visit(Eigen::Vector3f(x, y, z));
}

/// Share of the places within its image of which a map does not say what the rays of the scene's camera met.
double share_wrong(const DepthMap& map, const AnalyticScene& scene) {
  int wrong = 0, total = 0;
  for_each_probe([&](const Eigen::Vector3f& p) {
    const Eigen::Vector3d ray = p.cast<double>() / static_cast<double>(p.z());
    const double reach_px = scene.camera.focal_px * ray.x(), drop_px = scene.camera.focal_px * ray.y();
    if (std::abs(reach_px) > scene.camera.width / 2 || std::abs(drop_px) > scene.camera.height / 2) return;
    double nearest = 1e9;
    for (const AnalyticSolid& solid : scene.solids) {
      const auto chord = intersect(solid, Eigen::Vector3d::Zero(), ray);
      if (chord && chord->enter > 0) nearest = std::min(nearest, chord->enter);
    }
    const double behind = static_cast<double>(p.z()) - nearest;
    if (std::abs(behind - static_cast<double>(kMargin)) < 0.004) return;
    ++total;
    wrong += (map.hider(p, kMargin) != DepthMap::kFree) != (behind > static_cast<double>(kMargin)) ? 1 : 0;
  });
  return static_cast<double>(wrong) / total;
}

void expect_same_map(const DepthMap& a, const DepthMap& b) {
  for_each_probe([&](const Eigen::Vector3f& p) {
    ASSERT_EQ(a.hider(p, kMargin), b.hider(p, kMargin)) << p.transpose();
    ASSERT_EQ(a.ray_area(p), b.ray_area(p)) << p.transpose();
  });
}

TEST(DepthMapImage, EachPointHidesWhatIsBehindIt) {
  PointCloud image = render(seen_scene()).cloud;
  for (const auto& [step_u, step_v] : {std::pair{1, 1}, {1, 2}, {3, 2}}) {
    const WorkspaceResult kept = filter_workspace(thinned(image, step_u, step_v), {});
    const DepthMap map(kept.cloud, kept.pixels);
    for (std::size_t i = 0; i < kept.cloud.size(); ++i) {
      const Eigen::Vector3f p = kept.cloud.point(i);
      ASSERT_EQ(map.hider(1.2f * p, kMargin), static_cast<std::int32_t>(i)) << step_u << " x " << step_v;
      ASSERT_EQ(map.hider(0.99f * p, kMargin), DepthMap::kFree);
    }
  }
}

TEST(DepthMapImage, TellsWhatTheRaysOfASceneMet) {
  const AnalyticScene scene = seen_scene();
  const PointCloud image = render(scene).cloud;
  const WorkspaceResult kept = filter_workspace(image, {});
  EXPECT_LT(share_wrong(DepthMap(kept.cloud, kept.pixels), scene), 0.01);
  const WorkspaceResult stretched = filter_workspace(thinned(image, 1, 2), {});
  EXPECT_LT(share_wrong(DepthMap(stretched.cloud, stretched.pixels), scene), 0.02) << "fx is twice fy";
}

TEST(DepthMapImage, AgreesWithTheRenderedOne) {
  PointCloud image = render(seen_scene()).cloud;
  for (std::size_t i = 0; i < image.size(); i += 11) make_missing(image, i);
  const WorkspaceResult kept = filter_workspace(image, {});
  const DepthMap own(kept.cloud, kept.pixels), rendered(kept.cloud);
  int hidden = 0, differ = 0, total = 0;
  for_each_probe([&](const Eigen::Vector3f& p) {
    if (own.hider(p, kMargin) == DepthMap::kOutOfView) return;
    const bool is_hidden = own.hider(p, kMargin) != DepthMap::kFree;
    hidden += is_hidden ? 1 : 0;
    differ += is_hidden != (rendered.hider(p, kMargin) != DepthMap::kFree) ? 1 : 0;
    ++total;
    EXPECT_NEAR(own.ray_area(p) / rendered.ray_area(p), 1, 0.25f) << p.transpose();
  });
  EXPECT_GT(hidden, total / 10);
  EXPECT_LT(hidden, total * 9 / 10);
  EXPECT_LT(differ, total / 50) << "of " << total;
}

TEST(DepthMapImage, SeveralPlacesAtOnceAreAnsweredAlike) {
  const WorkspaceResult kept = filter_workspace(thinned(render(seen_scene()).cloud, 1, 3), {});
  const DepthMap map(kept.cloud, kept.pixels);
  Probes places{};
  std::int32_t hiders[kProbes];
  for (std::size_t k = 0; k < kProbes; ++k) {
    places.x[k] = 0.03f * static_cast<float>(k) - 0.1f;
    places.y[k] = 0.02f * static_cast<float>(k) - 0.1f;
    places.z[k] = 0.9f;
  }
  map.find_hiders(places, kMargin, hiders);
  for (std::size_t k = 0; k < kProbes; ++k)
    EXPECT_EQ(hiders[k], map.hider({places.x[k], places.y[k], places.z[k]}, kMargin)) << k;
}

/// The surface that all rays together cover does not depend on how many there are.
TEST(DepthMapImage, AnAreaForEachPoint) {
  const PointCloud image = grid_patch({-0.16f, -0.12f, 1}, {0.002f, 0, 0}, {0, 0.002f, 0}, 160, 120);
  const auto area = [](const PointCloud& cloud) {
    const WorkspaceResult kept = filter_workspace(cloud, {});
    const DepthMap map(kept.cloud, kept.pixels);
    EXPECT_NEAR(map.ray_area({0, 0, 2}) / map.ray_area({0, 0, 1}), 4, 1e-3f);
    return map.ray_area({0, 0, 1}) * static_cast<float>(kept.cloud.size());
  };
  PointCloud organized = image;
  organized.width = 160;
  organized.height = 120;
  EXPECT_NEAR(area(organized), 160 * 120 * 0.002f * 0.002f, 1e-4f);
  EXPECT_NEAR(area(thinned(organized, 1, 4)), 160 * 120 * 0.002f * 0.002f, 2e-3f) << "fx is four times fy";
  for (std::size_t i = 0; i < organized.size(); i += 3) make_missing(organized, i);
  EXPECT_NEAR(area(organized), 160 * 120 * 0.002f * 0.002f, 1e-3f) << "the others stand for the missing ones";
}

TEST(DepthMapImage, GapsInARowTakeTheFartherEndAndLongOnesStay) {
  PointCloud image = grid_patch({-0.5f, -0.5f, 1}, {0.01f, 0, 0}, {0, 0.01f, 0}, 101, 101);
  image.width = image.height = 101;
  const auto at = [](std::size_t u, std::size_t v) { return v * 101 + u; };
  for (std::size_t v = 20; v < 60; ++v)
    for (std::size_t u = 40; u < 101; ++u) {
      const std::size_t i = at(u, v);
      image.x[i] *= 2;  // on the same rays
      image.y[i] *= 2;
      image.z[i] *= 2;
    }
  for (std::size_t u = 36; u < 44; ++u) make_missing(image, at(u, 30));
  for (std::size_t u = 30; u < 50; ++u) make_missing(image, at(u, 40));
  for (std::size_t u = 97; u < 101; ++u) make_missing(image, at(u, 50));
  for (std::size_t u = 0; u < 4; ++u) make_missing(image, at(u, 51));
  const WorkspaceResult kept = filter_workspace(image, {});
  const DepthMap map(kept.cloud, kept.pixels);
  const auto hider = [&](int u, int v, float depth) {
    const Eigen::Vector3f ray(0.01f * static_cast<float>(u - 50), 0.01f * static_cast<float>(v - 50), 1);
    return map.hider(depth * ray, kMargin);
  };
  for (int u = 36; u < 44; ++u) {
    EXPECT_EQ(hider(u, 30, 1.9f), DepthMap::kFree) << "before the farther end, at " << u;
    EXPECT_NE(hider(u, 30, 2.1f), DepthMap::kFree) << u;
  }
  EXPECT_NE(hider(35, 30, 1.5f), DepthMap::kFree);
  EXPECT_EQ(hider(40, 40, 3), DepthMap::kFree) << "too long to guess";
  for (const int u : {98, 100}) EXPECT_EQ(hider(u, 50, 3), DepthMap::kFree) << "a gap with one end";
  for (const int u : {0, 2}) EXPECT_EQ(hider(u, 51, 3), DepthMap::kFree) << "a gap with one end";
}

TEST(DepthMapImage, PartOfTheImageInTheWorkspace) {
  const PointCloud image = render(seen_scene()).cloud;
  WorkspaceFilterConfig config;
  config.min_m = {-0.08f, -0.05f, 0};
  config.max_m = {0.1f, 0.07f, 2};
  const WorkspaceResult kept = filter_workspace(image, config);
  ASSERT_GT(kept.cloud.size(), 1000u);
  const DepthMap map(kept.cloud, kept.pixels);
  for (std::size_t i = 0; i < kept.cloud.size(); ++i)
    ASSERT_EQ(map.hider(1.2f * kept.cloud.point(i), kMargin), static_cast<std::int32_t>(i));
  EXPECT_EQ(map.hider({-0.15f, 0, 0.9f}, kMargin), DepthMap::kFree);
  EXPECT_EQ(map.hider({-0.6f, 0, 0.9f}, kMargin), DepthMap::kOutOfView);
  EXPECT_EQ(map.hider({0, -0.2f, 0.9f}, kMargin), DepthMap::kFree);
  EXPECT_EQ(map.hider({0, 0.2f, 0.9f}, kMargin), DepthMap::kFree);
}

TEST(DepthMapImage, BeyondItsBordersNothingIsSeen) {
  PointCloud image = grid_patch({-0.5f, -0.5f, 1}, {0.01f, 0, 0}, {0, 0.01f, 0}, 101, 101);
  image.width = image.height = 101;
  const auto hiders_with_band = [&](std::size_t columns, std::size_t rows) {
    PointCloud part = image;
    for (std::size_t v = 0; v < 101; ++v)
      for (std::size_t u = 0; u < 101; ++u)
        if (u < columns || v < rows) make_missing(part, v * 101 + u);
    const WorkspaceResult kept = filter_workspace(part, {});
    const auto map = std::make_shared<const DepthMap>(kept.cloud, kept.pixels);
    return [map](float x, float y, float depth) {
      return map->hider({depth * x, depth * y, depth}, kMargin);
    };
  };
  const auto whole = hiders_with_band(0, 0), narrow = hiders_with_band(4, 3), wide = hiders_with_band(20, 15);
  for (const float depth : {0.5f, 1.5f}) {
    for (const auto& [x, y] :
         {std::pair{-0.6f, 0.0f}, {0.6f, 0.0f}, {0.0f, -0.6f}, {0.0f, 0.6f}, {0.7f, -0.7f}})
      EXPECT_EQ(whole(x, y, depth), DepthMap::kOutOfView) << x << " " << y << " " << depth;
    EXPECT_EQ(whole(-0.48f, 0, 0.5f), DepthMap::kFree);
    EXPECT_EQ(narrow(-0.48f, 0, depth), DepthMap::kOutOfView)
        << "a band at the border where sensors see nothing";
    EXPECT_EQ(narrow(0, -0.49f, depth), DepthMap::kOutOfView);
    EXPECT_EQ(wide(-0.48f, 0, depth), DepthMap::kFree) << "what lies there is too far away, or was left out";
    EXPECT_EQ(wide(0, -0.49f, depth), DepthMap::kFree);
  }
  EXPECT_EQ(whole(0.6f, 0, -1), DepthMap::kFree) << "behind the sensor";
}

TEST(DepthMapImage, RenderedWhereTheModelDoesNotFit) {
  const AnalyticScene scene = seen_scene();
  const PointCloud image = render(scene).cloud;
  PointCloud distorted = image;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const float u = image.x[i] / image.z[i], v = image.y[i] / image.z[i];
    distorted.x[i] *= 1 + 0.3f * (u * u + v * v);
    distorted.y[i] *= 1 + 0.3f * (u * u + v * v);
  }
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = Eigen::AngleAxisf(0.2f, Eigen::Vector3f::UnitY()).toRotationMatrix();
  PointCloud line = image;
  line.width = static_cast<int>(image.size());
  line.height = 1;
  for (const PointCloud& cloud : {distorted, moved(image, T), line, shuffled(image, 1)}) {
    const WorkspaceResult kept = filter_workspace(cloud, {});
    expect_same_map(DepthMap(kept.cloud, kept.pixels), DepthMap(kept.cloud));
  }
}

}  // namespace
}  // namespace graspd
