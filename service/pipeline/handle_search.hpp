// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Candidates: gripper poses worth checking. The bands of the paper along each segment's axes, and seeds
// spread over each object with the approaches and closing axes that its surfaces suggest.
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "service/pipeline/handle_check.hpp"
#include "service/pipeline/normals.hpp"
#include "service/pipeline/objects.hpp"
#include "service/pipeline/segments.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

struct HandleSearchConfig {
  bool bands = true;
  bool seeds = true;
  float seed_spacing_m = 0.025f;
  float min_facing_cosine = 0.17f;
  float distinct_angle_deg = 12.0f;
  int all_directions = 18;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("bands", self.bands, Range{}, "the paper's bands along the principal axes of each segment");
    v("seeds", self.seeds, Range{}, "seeds over each object, with several approaches and closing axes");
    v("seed_spacing_m", self.seed_spacing_m, Range{0.005, 1}, "between seeds [m]");
    v("min_facing_cosine", self.min_facing_cosine, Range{0, 1},
      "cosine between the line of sight and the approach; smaller: the hand comes from behind");
    v("distinct_angle_deg", self.distinct_angle_deg, Range{1, 90},
      "directions closer than this are tried once [degrees]");
    v("all_directions", self.all_directions, Range{0, 180},
      "closing axes over half a turn, tried on objects that have no handle otherwise");
  }
};

/// The frame as the search sees it: voxels, their normals, segments and objects.
struct SearchInput {
  const PointCloud& cloud;
  const Normals& normals;
  const Segments& segments;
  const Objects& objects;
  const ObjectPoints& object_points;
  const std::optional<Support>& support;
};

/// Candidates come in rounds, each for the objects on which those before found too few handles: what a
/// surface itself suggests, then what the support and the line of sight do, then every direction.
enum class SearchRound : std::uint8_t { kSurface, kSurroundings, kAllDirections };
inline constexpr std::array kSearchRounds{SearchRound::kSurface, SearchRound::kSurroundings,
                                          SearchRound::kAllDirections};

/// A few unit vectors.
class FewDirections {
 public:
  static constexpr std::size_t kMost = 12;

  /// There must be room.
  void add(const Eigen::Vector3f& unit) { directions_[size_++] = unit; }
  /// Adds that of a vector unless it is too short to have one, or one is there whose cosine with it is
  /// larger; signless: opposite ones are the same.
  void add_distinct(const Eigen::Vector3f& v, float max_cosine, bool signless);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Eigen::Vector3f& operator[](std::size_t i) const { return directions_[i]; }
  [[nodiscard]] std::span<const Eigen::Vector3f> all() const { return {directions_.data(), size_}; }

 private:
  std::array<Eigen::Vector3f, kMost> directions_;
  std::size_t size_ = 0;
};

class HandleSearch {
 public:
  /// All must outlive the search. wanted: 1 for each segment that candidates are asked for.
  HandleSearch(const SearchInput& input, const Gripper& gripper, const HandleSearchConfig& config,
               const std::pmr::vector<std::uint8_t>& wanted);

  /// open: 1 for each object that candidates are asked for, on those of its segments that are wanted.
  [[nodiscard]] std::pmr::vector<Candidate> candidates(SearchRound round,
                                                       const std::pmr::vector<std::uint8_t>& open) const;

 private:
  using Directions = std::pmr::vector<Eigen::Vector3f>;
  struct Seed {
    std::uint32_t point;
    FewDirections outward;  // opposite to the approaches worth trying, the best first
  };
  /// On the wanted segments.
  [[nodiscard]] std::pmr::vector<Seed> spread_seeds(std::span<const std::uint32_t> points) const;
  /// n: of the face that the seed is on.
  [[nodiscard]] FewDirections outward_directions(std::uint32_t seed, const Eigen::Vector3f& n) const;
  [[nodiscard]] FewDirections major_axes(std::size_t segment, const Eigen::Vector3f& outward) const;
  [[nodiscard]] Directions other_axes(const Eigen::Vector3f& outward, const FewDirections& tried) const;
  void add_bands(std::size_t segment, const Eigen::Vector3f& axis, std::pmr::vector<Candidate>& out) const;
  void add_seeds(std::size_t object, SearchRound round, std::pmr::vector<Candidate>& out) const;

  const SearchInput& in_;
  const std::pmr::vector<std::uint8_t>& wanted_;
  const Gripper& gripper_;
  const HandleSearchConfig& config_;
  float max_cosine_;                                // between directions that are distinct
  Directions rectangle_axes_;                       // of each segment
  std::pmr::vector<std::pmr::vector<Seed>> seeds_;  // of each object
};

}  // namespace graspd
