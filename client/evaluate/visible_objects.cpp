// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/visible_objects.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace graspd {
namespace {

using Eigen::Vector3d;

class Viewer {
 public:
  Viewer(const Scene& scene, const DepthFrame& frame, const Eigen::Isometry3d& T_world_camera,
         double spot_spacing_m)
      : scene_(scene), frame_(frame), T_world_camera_(T_world_camera), spot_spacing_m_(spot_spacing_m) {
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
      if (scene.solids[i].label < object_label(kFirstObject)) continue;
      index_[scene.solids[i].label] = objects_.size();
      objects_.push_back({i, 0, 0, {}});
    }
  }

  std::vector<VisibleObject> run() {
    for (int v = 0; v < frame_.camera.height; ++v)
      for (int u = 0; u < frame_.camera.width; ++u) add_pixel(u, v);
    std::erase_if(objects_, [](const VisibleObject& object) { return object.pixels == 0; });
    return std::move(objects_);
  }

 private:
  void add_pixel(int u, int v) {
    const Pinhole& camera = frame_.camera;
    const auto i =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(u);
    const auto found = index_.find(frame_.label[i]);
    const double z = static_cast<double>(frame_.depth_m[i]);
    if (found == index_.end() || z <= 0) return;
    VisibleObject& object = objects_[found->second];
    const Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
    constexpr double kGrazing = 0.15;
    const double cosine = std::max(kGrazing, static_cast<double>(frame_.cos_incidence[i]));
    object.pixels += 1;
    object.surface_m2 += z * z / (camera.fx * camera.fy * cosine * ray.norm());
    add_spot(object, T_world_camera_.linear() * ray, T_world_camera_ * Vector3d(z * ray));
  }

  void add_spot(VisibleObject& object, const Vector3d& direction, const Vector3d& point) {
    const Eigen::Array3i cube = (point / spot_spacing_m_).array().floor().cast<int>();
    if (!cubes_.insert({object.solid, cube.x(), cube.y(), cube.z()}).second) return;
    // Once more, for the normal; from a little before the point.
    const Solid& solid = scene_.solids[object.solid];
    const Eigen::Isometry3d T_solid_world = solid.T_world_solid.inverse();
    constexpr double kBefore = 0.001;
    const Ray ray{T_solid_world * Vector3d(point - kBefore * direction), T_solid_world.linear() * direction};
    if (const auto hit = cast_in_solid(solid, ray))
      object.spots.push_back({point, solid.T_world_solid.linear() * hit->normal});
  }

  const Scene& scene_;
  const DepthFrame& frame_;
  const Eigen::Isometry3d& T_world_camera_;
  double spot_spacing_m_;
  std::vector<VisibleObject> objects_;
  std::map<std::uint32_t, std::size_t> index_;  // of an object, by label
  std::set<std::tuple<std::size_t, int, int, int>> cubes_;
};

}  // namespace

std::vector<VisibleObject> visible_objects(const Scene& scene, const DepthFrame& frame,
                                           const Eigen::Isometry3d& T_world_camera, double spot_spacing_m) {
  return Viewer(scene, frame, T_world_camera, spot_spacing_m).run();
}

}  // namespace graspd
