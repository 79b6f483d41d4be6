// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Waits for handles and prints, as one line of JSON, the poses that take an object:
//   lcm-gen --cpp --cpp-hpath build lcmtypes/*.lcm
//   g++ -std=c++17 client/tutorial/pick.cpp -Ibuild -I/usr/include/eigen3 -llcm -o pick
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <optional>

#include "graspd/handle_list_t.hpp"

constexpr double kClearance_m = 0.004;  // detect.check.clearance_m: free on each side of the object
constexpr double kWay_m = 0.100;        // detect.check.way_m: so far back the hand's way is free
constexpr double kLift_m = 0.100;
constexpr double kMinScore = 0.5;

struct Steps {
  double opening_m = 0, object_m = 0;
  Eigen::Isometry3d pre_grasp, grasp, lifted;  // of a frame between the fingertips, in the base frame
};

/// Yours to write: inverse kinematics and collisions of the arm. Here: a box before the robot.
bool is_reachable(const Eigen::Isometry3d& T) {
  const Eigen::Vector3d p = T.translation();
  return (p.array() > Eigen::Array3d(0.1, -0.6, 0.0)).all() &&
         (p.array() < Eigen::Array3d(1.0, 0.6, 0.8)).all();
}

/// Gripper frame to the list's frame.
Eigen::Isometry3d pose_of(const graspd::handle_t& handle) {
  const double* q = handle.orientation;
  return Eigen::Translation3d(Eigen::Vector3d(handle.position)) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

std::optional<Steps> plan(const graspd::handle_list_t& answer) {
  for (const graspd::handle_t& handle : answer.handles) {
    if (handle.score < kMinScore) break;  // the best come first
    Steps steps;
    // From the object's surface on to the fingertips.
    steps.grasp = pose_of(handle) * Eigen::Translation3d(0, 0, answer.gripper.grasp_depth);
    // The same grip, half a turn less for the wrist.
    if (steps.grasp(0, 0) < 0) steps.grasp.rotate(Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitZ()));
    steps.pre_grasp = steps.grasp * Eigen::Translation3d(0, 0, -kWay_m);
    steps.lifted = Eigen::Translation3d(0, 0, kLift_m) * steps.grasp;  // up in the base frame
    if (!is_reachable(steps.pre_grasp) || !is_reachable(steps.grasp) || !is_reachable(steps.lifted)) continue;
    steps.opening_m = std::min(answer.gripper.aperture, handle.width + 2 * kClearance_m);
    steps.object_m = handle.width;
    return steps;
  }
  return std::nullopt;
}

void print(const char* name, const Eigen::Isometry3d& T) {
  std::printf(", \"%s\": [", name);
  for (int row = 0; row < 4; ++row)
    std::printf("%s[%.9g, %.9g, %.9g, %.9g]", row > 0 ? ", " : "", T(row, 0), T(row, 1), T(row, 2),
                T(row, 3));
  std::printf("]");
}

struct Picker {
  bool is_done = false;

  void on_answer(const lcm::ReceiveBuffer*, const std::string&, const graspd::handle_list_t* answer) {
    const auto steps = answer->status == graspd::handle_list_t::OK ? plan(*answer) : std::nullopt;
    if (is_done || !steps) {
      if (!is_done) std::fprintf(stderr, "nothing to pick: %s\n", answer->status_text.c_str());
      return;
    }
    is_done = true;
    std::printf("{\"utime\": %lld, \"seq\": %lld, \"frame\": \"%s\"", static_cast<long long>(answer->utime),
                static_cast<long long>(answer->seq), answer->frame_name.c_str());
    std::printf(", \"opening_m\": %.9g, \"object_m\": %.9g", steps->opening_m, steps->object_m);
    print("pre_grasp", steps->pre_grasp);
    print("grasp", steps->grasp);
    print("lifted", steps->lifted);
    std::printf("}\n");
  }
};

int main() {
  lcm::LCM lcm;  // LCM_DEFAULT_URL, else a group that stays on this machine
  if (!lcm.good()) return 1;
  Picker picker;
  lcm.subscribe("GRASPD_HANDLES", &Picker::on_answer, &picker);
  while (!picker.is_done) {
    if (lcm.handleTimeout(60'000) <= 0) return 1;  // no answer for a minute: see config/troubleshooting.md
  }
  return 0;
}
