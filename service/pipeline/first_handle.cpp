// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/first_handle.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "service/pipeline/careful_check.hpp"
#include "service/pipeline/object_shape.hpp"

namespace graspd {
namespace {

/// A handle and what it is worth as the first of its object; 0 is the worth of none.
struct Choice {
  FoundHandle found;
  float worth = 0;
};

float log_odds(float score) {
  const float p = std::clamp(score, 1e-6f, 1 - 1e-6f);
  return std::log(p / (1 - p));
}

Eigen::Matrix3f axes_of(const Eigen::Vector3f& approach, const Eigen::Vector3f& closing) {
  Eigen::Matrix3f axes;
  axes.col(2) = approach;
  axes.col(1) = (closing - closing.dot(approach) * approach).normalized();
  axes.col(0) = axes.col(1).cross(approach);
  return axes;
}

/// Chooses for one object.
class Chooser {
 public:
  /// found: any handle of the object.
  Chooser(const FoundHandle& found, const ObjectShape& shape, const std::optional<Support>& support,
          const Gripper& gripper, const HandleCheckConfig& config, CheckBuffers& buffers)
      : found_(found),
        shape_(shape),
        support_(support),
        gripper_(gripper),
        config_(config),
        buffers_(buffers) {}

  [[nodiscard]] FoundHandle first(std::pmr::vector<FoundHandle> found) const;

 private:
  [[nodiscard]] float worth(const FoundHandle& found) const;
  [[nodiscard]] Eigen::Vector3f preferred_approach() const;
  [[nodiscard]] std::optional<FoundHandle> as_handle(const Candidate& candidate,
                                                     const CheckResult& result) const;
  [[nodiscard]] std::pmr::vector<Eigen::Matrix3f> steady_rotations() const;
  [[nodiscard]] Choice moved_to_middle(const FoundHandle& found) const;

  const FoundHandle& found_;
  const ObjectShape& shape_;
  const std::optional<Support>& support_;
  const Gripper& gripper_;
  const HandleCheckConfig& config_;
  CheckBuffers& buffers_;
};

/// From above, where it is known what that is: the top of an object is seen best, and nothing stands in the
/// way.
Eigen::Vector3f Chooser::preferred_approach() const {
  return support_ ? Eigen::Vector3f(-support_->plane.normal) : shape_.sight();
}

/// The log odds, and what decides between handles that are about equally good. The weights make the
/// difference between two ways to take an object larger than what noise does to their scores.
float Chooser::worth(const FoundHandle& found) const {
  constexpr float kStraight = 2.8f, kWide = 2.8f, kInDepth = 1.4f, kOffMiddle = 4.0f;
  const Handle& handle = found.ranked.handle;
  return log_odds(handle.score) + kStraight * handle.rotation.col(2).dot(preferred_approach()) -
         kWide * handle.width_m / gripper_.aperture_m -
         kInDepth * std::abs(handle.rotation.col(1).dot(shape_.sight())) -
         kOffMiddle * (1 - found.margins.central);
}

std::optional<FoundHandle> Chooser::as_handle(const Candidate& candidate, const CheckResult& result) const {
  if (result.failure != Failure::kNone) return std::nullopt;
  FoundHandle found = found_;
  found.candidate = candidate;
  found.ranked.handle = result.handle;
  found.margins = result.margins;
  rate(found, shape_.center());
  return found;
}

/// Ways to take the object that do not come from its segments: along the line of sight and from above,
/// closing level across the line of sight, or across the object's long axis where that is another direction.
std::pmr::vector<Eigen::Matrix3f> Chooser::steady_rotations() const {
  constexpr float kSameCosine = 0.97f, kMinSine = 0.5f;
  std::pmr::vector<Eigen::Vector3f> approaches{shape_.sight()};
  std::pmr::vector<Eigen::Matrix3f> rotations;
  Eigen::Vector3f level = Eigen::Vector3f::Zero();
  if (support_) {
    approaches.emplace_back(-support_->plane.normal);
    level = shape_.sight().cross(support_->plane.normal).normalized();
    for (const Eigen::Vector3f& approach : approaches) rotations.push_back(axes_of(approach, level));
  }
  if (const std::optional<Eigen::Vector3f> axis = shape_.long_axis())
    for (const Eigen::Vector3f& approach : approaches) {
      const Eigen::Vector3f across = approach.cross(*axis);
      if (across.norm() > kMinSine && std::abs(across.normalized().dot(level)) < kSameCosine)
        rotations.push_back(axes_of(approach, across));
    }
  return rotations;
}

/// Along the major axis to the object's middle, or next to it where that fails. The worth is that of the
/// result and the mean over these places, which noise moves less. A wall whose normal is known at one place
/// may have another at the next: there it stays.
Choice Chooser::moved_to_middle(const FoundHandle& found) const {
  if (found.candidate.is_on_known_wall()) return {found, 2 * worth(found)};
  constexpr std::array<float, 3> kSteps{0, -0.015f, 0.015f};  // from the middle [m]
  const Handle& handle = found.ranked.handle;
  const Eigen::Vector3f major = handle.rotation.col(0);
  const float to_middle = shape_.middle(major) - major.dot(handle.position);
  std::optional<FoundHandle> moved;
  float sum_of_worths = 0;
  for (const float step : kSteps) {
    Candidate candidate = found.as_candidate();
    candidate.position += (to_middle + step) * major;
    const auto there =
        as_handle(candidate, check_candidate(*found.scene, gripper_, config_, candidate, buffers_));
    if (!there) continue;
    sum_of_worths += worth(*there);
    if (!moved) moved = there;
  }
  if (!moved) return {found, worth(found)};
  return {*moved, worth(*moved) + sum_of_worths / static_cast<float>(kSteps.size())};
}

/// Chooses between the edges of thin walls and other ways to take an object. Where one is held by its rim,
/// whatever else is narrow between the jaws is the same wall, met askew. What can be taken otherwise with
/// some chance is: there more is seen of what the jaws meet.
void choose_about_edges(std::pmr::vector<FoundHandle>& found) {
  constexpr float kNarrow = 0.025f;  // [m]
  constexpr float kLikely = 0.61f;   // score
  const auto by_edge = [](const FoundHandle& f) { return f.margins.has_thin_edge(); };
  const auto on_rim = [](const FoundHandle& f) { return f.candidate.is_on_known_wall(); };
  if (std::any_of(found.begin(), found.end(), [&](const auto& f) { return by_edge(f) && on_rim(f); }))
    std::erase_if(found, [&](const FoundHandle& f) {
      return !by_edge(f) && !on_rim(f) && f.ranked.handle.width_m < kNarrow;
    });
  const auto is_likely = [&](const FoundHandle& f) {
    return !by_edge(f) && f.ranked.handle.score >= kLikely;
  };
  if (std::any_of(found.begin(), found.end(), is_likely)) std::erase_if(found, by_edge);
}

FoundHandle Chooser::first(std::pmr::vector<FoundHandle> found) const {
  constexpr std::size_t kMoved = 2;  // the most promising ones
  for (const Eigen::Matrix3f& rotation : steady_rotations()) {
    std::optional<Candidate> place = shape_.middle_place(rotation, gripper_);
    if (!place) continue;
    // Reports of segments know only the search: a surface without a handle there keeps none.
    const auto is_there = [&](const FoundHandle& f) { return f.ranked.handle.segment == place->segment; };
    if (std::none_of(found.begin(), found.end(), is_there)) place->segment = found_.ranked.handle.segment;
    if (const auto handle =
            as_handle(*place, check_squarely(*found_.scene, gripper_, config_, *place, buffers_)))
      found.push_back(*handle);
  }
  choose_about_edges(found);
  std::pmr::vector<std::pair<float, std::size_t>> order;  // the most worth first, of equal ones the first
  for (std::size_t k = 0; k < found.size(); ++k) order.emplace_back(-worth(found[k]), k);
  std::sort(order.begin(), order.end());
  Choice best = moved_to_middle(found[order.front().second]);
  const std::size_t num_moved = std::min(kMoved, found.size());
  for (std::size_t k = 1; k < num_moved; ++k)
    if (const Choice other = moved_to_middle(found[order[k].second]); other.worth > best.worth) best = other;
  FoundHandle& first = best.found;
  first.margins.steady = steadiness(*first.sparse, gripper_, config_, first.as_candidate(), buffers_);
  first.ranked.handle.score = score(first.margins);
  first.ranked.is_first = true;
  return first;
}

}  // namespace

std::pmr::vector<FoundHandle> first_handles(const std::pmr::vector<FoundHandle>& found,
                                            const Surfaces& surfaces, const Gripper& gripper,
                                            const HandleCheckConfig& config, CheckBuffersOfThreads& buffers) {
  std::pmr::map<int, std::pmr::vector<FoundHandle>> by_object;
  for (const FoundHandle& handle : found) by_object[handle.ranked.object].push_back(handle);
  std::pmr::vector<std::pmr::vector<FoundHandle>> of_object;
  std::pmr::vector<FoundHandle> first;
  for (auto& [object, handles] : by_object) {
    first.push_back(handles.front());
    of_object.push_back(std::move(handles));
  }
  tbb::parallel_for(std::size_t{0}, first.size(), [&](std::size_t k) {
    const FoundHandle& any = of_object[k].front();
    const auto object = static_cast<std::size_t>(any.candidate.object);
    const ObjectShape shape(surfaces, any.guess->points.of(object), any.candidate.object,
                            any.guess->objects.center[object]);
    const Chooser chooser(any, shape, surfaces.support, gripper, config, buffers.local());
    first[k] = chooser.first(of_object[k]);
  });
  return first;
}

}  // namespace graspd
