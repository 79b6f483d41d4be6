// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The loops over points that most of the time goes into. Each has a portable form and one for processors with
// AVX2, which is chosen at run time; both do the same operations on each point in the same order, so that the
// results are the same to the bit.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "service/pipeline/cell_run.hpp"

namespace graspd {

/// Points in order of a grid's cells. Arrays must be readable for kPointPadding entries beyond the last that
/// is asked for.
struct PointRange {
  const float *x, *y, *z;      ///< [m]
  const std::uint32_t* index;  ///< into the cloud
  std::size_t size;
};
inline constexpr std::size_t kPointPadding = 8;

/// Those at positions [begin, end) of a range.
struct PointSpan {
  std::uint32_t begin, end;
};

/// Of sorted runs.
struct CellCounts {
  std::uint32_t cells = 0;  ///< that begin there
  std::uint32_t points = 0;
};

/// Where the cells of a part of sorted runs go, and their points: those at positions [first, last).
struct CellOutput {
  std::int64_t* keys;
  std::uint32_t *starts, *points;
  std::uint32_t num_cells, first, last;
};

/// Points of some cells, by indices, those of one cell after the other; each has at least one.
struct CellPoints {
  const float *x, *y, *z;
  const std::uint32_t* index;
  const std::uint32_t* starts;  ///< num_cells + 1 positions among the indices where a cell's begin
  std::size_t num_cells;
};

/// A box, and what takes points to its coordinates: local = to_local p + shift.
struct BoxTest {
  float to_local[3][3];  ///< rows
  float shift[3], min[3], max[3];
};

/// Where points in a box go, in its coordinates or their own. There must be room for as many as there are in
/// the spans
/// + kPointPadding.
struct LocalOutput {
  float *a, *f, *z;
  std::uint32_t* index;
};

/// Rows of cells along x in one layer of a grid. Arrays must be readable for kPointPadding entries beyond the
/// last.
struct CellRows {
  const std::int32_t *y, *x, *num_cells;  ///< x of the first cell
  std::size_t size;
};

/// What four pairs of planes leave of the x of a row around y: least - slope y to most - slope y for each.
struct RowLimits {
  float least[4], most[4], slope[4];  ///< [m]
  float cell_m;
};

/// A regular grid whose cells are numbered in 32 bits: min_cell has number 0, the next along x 1, and so on.
struct CellGrid {
  float per_cell;  ///< cells a metre
  int min_cell[3];
  std::uint32_t row, layer;  ///< from one number to the same place in the next row along y, and layer along z
};

/// Points of a band as the fit of a patch sees them.
struct BandPoints {
  const float *f, *z;
  const std::uint32_t* index;  ///< into the cloud
  std::size_t size;
};

/// Whose points are the candidate's, and how the profile along f is divided.
struct BandTags {
  const std::int32_t* object_of_voxel;
  const std::uint32_t* voxel_of_point;
  std::int32_t object;
  float first, bin;  ///< where bin 0 begins, and the length of each [m]
  std::int32_t num_bins;

  /// From the mark of a bin for points of others to the one for the object's: the bins, rounded up to whole
  /// words.
  [[nodiscard]] std::size_t stride() const { return (static_cast<std::size_t>(num_bins) + 63) / 64 * 64; }
  /// The mark of points that have no bin.
  [[nodiscard]] std::int32_t no_mark() const { return static_cast<std::int32_t>(2 * stride()); }
};

/// Part of a band; bounds belong to it.
struct BandPart {
  float f_min, f_max, z_min;
};

/// Part of a band, about its middle and top; bounds belong to it.
struct BandLimits {
  float middle, top;                 ///< f and z that distances and depths are from
  float min_distance, max_distance;  ///< of |f - middle|
  float min_depth, max_depth;        ///< of z - top
};

/// Points within limits: all, and those of the object.
struct BandCounts {
  std::size_t all, own;
};

/// A point and the indices of its neighbours. As many as kPointPadding more must be readable and be those of
/// points.
struct NeighborList {
  std::uint32_t point;
  std::uint32_t size;
  const std::uint32_t* indices;
};

/// Sums over the neighbours of a point of their offsets from it and of the products of the offsets, and how
/// many there are: of kSolved points side by side.
inline constexpr std::size_t kSolved = 8;
struct MomentLanes {
  float x[kSolved], y[kSolved], z[kSolved], xx[kSolved], xy[kSolved], xz[kSolved], yy[kSolved], yz[kSolved],
      zz[kSolved];
  float count[kSolved];
};
struct NormalLanes {
  float x[kSolved], y[kSolved], z[kSolved];
};

/// Unit vectors of all points.
struct NormalArrays {
  const float *x, *y, *z;
};

/// What links neighbours to one surface: the cosine of the angle between their normals is more than the
/// larger one of their least cosines.
struct LinkTest {
  NormalArrays normals;
  const float* least_cosine;    ///< of each point; more than 1: it takes part in no link
  const std::uint32_t* parent;  ///< of each point in its set
};

/// A point whose links are looked for: to points [first, last) outside of the set that root stands for.
struct LinkPlace {
  std::uint32_t point, root, first, last;
};

/// Links that were found.
struct FoundLinks {
  std::size_t num;
  bool any_beyond;  ///< whether points at or beyond the place's last were passed over
};

/// Ranges and a box that points must lie in; bounds belong to them.
struct WorkspaceTest {
  BoxTest box;
  float origin[3];                    ///< that distances are from [m]
  float least_squared, most_squared;  ///< of the distance [m2]
};

/// Where chosen points go.
struct ChosenPoints {
  float *x, *y, *z;
  std::uint32_t* position;  ///< may be null
  std::size_t room;         ///< in each; nothing beyond it is written
  std::uint32_t first;      ///< position of the first point that is asked for
};

/// Points with normals, and what makes one of them a plane's.
struct PlaneSample {
  const float *x, *y, *z;
  NormalArrays normals;
  std::size_t size;
};
struct PlaneTest {
  float normal[3], offset;
  float thickness, min_cosine;
};

/// A depth image and the view it was taken with.
struct ViewImage {
  float origin[3], axes[3][3];  ///< of the view in the cloud's frame; rows: right, down, forward
  float focal[2], center[2];    ///< along columns and rows [pixels]
  std::int32_t width, height;
  const float* depth;         ///< of each pixel; 0: nothing seen
  const std::int32_t* point;  ///< that the depth is of
  /// What hides places beyond the image: beside it, above and below.
  std::int32_t beside = -1, above = -1, below = -1;
};

/// Sums of unit vectors, in eight parts.
struct DirectionSums {
  float x[8], y[8], z[8];
};

/// Of x / z and y / z along the axes of a view.
struct SlopeBounds {
  float left, right, top, bottom;
};

/// Places in the cloud's frame that are looked at together [m].
inline constexpr std::size_t kProbes = 8;
struct Probes {
  float x[kProbes], y[kProbes], z[kProbes];
};

/// Of points in a plane, about a place of one's own: each has the weight 1 / (1 + e^2) by its distance e from
/// a circle, in units of a scale.
struct CircleWeights {
  float x, y, radius;  ///< [m]
  float per_scale;     ///< 1 / scale [1/m]; 0: all weights are 1
};

/// Weighted sums over them; q is x^2 + y^2.
struct CircleSums {
  double n, x, y, xx, xy, yy, q, qx, qy;
};

/// Points of a face, and a profile z = c0 + c1 s + c2 s^2 + c3 a through it: each has the weight
/// 1 / (1 + e^2) by its distance e from the profile along z, in units of a scale.
struct FacePoints {
  const float *s, *a, *z;
  std::size_t size;
};
struct ProfileWeights {
  float c[4];
  float per_scale;  ///< 1 / scale; 0: all weights are 1
};

/// Weighted sums over them; ee: of e^2.
struct ProfileSums {
  float n, s, ss, sss, ssss, a, as, ass, aa, z, zs, zss, za, ee;
};

/// How many values from one end first_few() finds.
inline constexpr std::size_t kFew = 4;

struct PointKernels {
  /// Sets bit k % 8 of masks[k / 8] for each of n points that is finite and in the workspace, and no others
  /// up to the next byte; returns how many are finite.
  std::size_t (*test_workspace)(const WorkspaceTest& test, const float* x, const float* y, const float* z,
                                std::size_t n, std::uint8_t* masks);
  /// Copies those of n points whose bits are set, in their order, and their positions.
  void (*copy_chosen)(const float* x, const float* y, const float* z, const std::uint8_t* masks,
                      std::size_t n, const ChosenPoints& out);
  /// Writes the points of some spans that are inside, in their order; returns their number.
  std::size_t (*keep_inside)(const BoxTest& box, const PointRange& points, std::span<const PointSpan> spans,
                             const LocalOutput& out);
  /// Number of points of some spans that are inside; stops after a span when they are more than enough.
  std::size_t (*count_inside)(const BoxTest& box, const PointRange& points, std::span<const PointSpan> spans,
                              std::size_t enough);
  /// Writes the cells [from, to) of each row, counted from its first, that lie within the limits; none where
  /// from >= to. There must be room for size + kPointPadding.
  void (*meet_rows)(const RowLimits& limits, const CellRows& rows, std::int32_t* from, std::int32_t* to);
  /// Writes the indices of the points of some spans within the distance of p, in their order; returns their
  /// number. There must be room for as many as there are in the spans + kPointPadding.
  std::size_t (*keep_near)(const float (&p)[3], float distance_squared, const PointRange& points,
                           std::span<const PointSpan> spans, std::uint32_t* out);
  /// Copies the points of some spans with coordinates in [min, max], in their order; returns their number.
  /// Room as for keep_near.
  std::size_t (*copy_inside)(const float (&min)[3], const float (&max)[3], const PointRange& points,
                             std::span<const PointSpan> spans, const LocalOutput& out);
  /// Of at most kSolved points; zero in the other lanes. Summed in eight parts, every eighth neighbour in
  /// one, which are added in order.
  void (*sum_moments)(const float* x, const float* y, const float* z, std::span<const NeighborList> lists,
                      MomentLanes& out);
  /// Normals of the planes through neighbourhoods, from their moments; zero where there is no plane.
  void (*solve_planes)(const MomentLanes& moments, NormalLanes& normals);
  /// Points of the sample nearer to the plane than its thickness and with normals like its own.
  int (*count_on_plane)(const PlaneTest& test, const PlaneSample& sample);
  /// How many of n points, by their indices, have a normal with a cosine to that of the point s less than the
  /// limit. Indices as of a NeighborList.
  std::size_t (*count_bent)(const NormalArrays& normals, std::uint32_t s, float limit,
                            const std::uint32_t* indices, std::size_t n);
  /// Writes those of n points, by their indices, that the point is linked to, in their order. There must be
  /// room for n + kPointPadding; indices as of a NeighborList. Of parents it reads those in [first, last)
  /// alone: others may change meanwhile.
  FoundLinks (*find_links)(const LinkTest& test, const LinkPlace& place, const std::uint32_t* indices,
                           std::size_t n, std::uint32_t* out);
  /// Whether one of n points, by their indices, has another value than the one given. Indices as of a
  /// NeighborList.
  bool (*any_other)(const std::int32_t* values, std::int32_t value, const std::uint32_t* indices,
                    std::size_t n);
  /// Writes those of n points, by their indices, with a value above the limit, in their order; returns their
  /// number. There must be room for n + kPointPadding; indices as of a NeighborList.
  std::size_t (*list_above)(const std::int32_t* values, std::int32_t limit, const std::uint32_t* indices,
                            std::size_t n, std::uint32_t* out);
  /// Writes the positions of those of n values that are not negative, ascending; returns their number. There
  /// must be room for n + kPointPadding.
  std::size_t (*list_members)(const std::int32_t* values, std::size_t n, std::uint32_t* out);
  /// The same for those of n marks that are 0.
  std::size_t (*list_unmarked)(const std::uint8_t* marks, std::size_t n, std::uint32_t* out);
  /// Summed in four parts, every fourth point in one, which are added in order. As many as kPointPadding more
  /// points must be readable.
  CircleSums (*sum_circle)(const CircleWeights& weights, const float* x, const float* y, std::size_t n);
  /// Summed in eight parts, every eighth point in one, which are added in order. As many as kPointPadding
  /// more points must be readable.
  ProfileSums (*sum_profile)(const ProfileWeights& weights, const FacePoints& face);
  /// Writes for each place the point that hides it, nearer than it by more than margin_m, or -1; what the
  /// image says for places beyond it.
  void (*find_hiders)(const ViewImage& image, const Probes& places, float margin_m,
                      std::int32_t (&hiders)[kProbes]);
  /// Adds the unit vectors from the view's origin to the points, every eighth point to one part. The ranges
  /// of this and the next two need no indices.
  void (*sum_directions)(const ViewImage& view, const PointRange& points, DirectionSums& sums);
  /// Widens the bounds to hold those of the points that are before the sensor.
  void (*extend_slopes)(const ViewImage& view, const PointRange& points, SlopeBounds& bounds);
  /// Writes the pixels that points fall on, row by row, or -1 outside of the image and behind the sensor, and
  /// how far forward they are [m].
  void (*find_pixels)(const ViewImage& view, const PointRange& points, std::int32_t* pixels, float* depths);
  /// Writes the smallest of n values, ascending, or the largest, descending; infinities where there are
  /// fewer.
  void (*first_few)(const float* v, std::size_t n, bool largest, float (&out)[kFew]);
  /// Widens [low, high] to hold n values; passes over NaN.
  void (*extend_bounds)(const float* v, std::size_t n, float& low, float& high);
  /// Writes the number of the cell of each of n points.
  void (*number_cells)(const CellGrid& grid, const float* x, const float* y, const float* z, std::size_t n,
                       std::uint32_t* out);
  /// How many of n keys differ from the one before them.
  std::size_t (*count_changes)(const std::uint32_t* keys, std::size_t n);
  /// Writes the runs among keys [begin, end), of which there are num, and no others; see begins_run().
  void (*write_runs)(const std::uint32_t* keys, std::size_t begin, std::size_t end,
                     CellRun<std::uint32_t>* out, std::size_t num);
  CellCounts (*count_cells)(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end);
  /// Writes the points of sorted runs [begin, end), the cells that begin there and where their points do, and
  /// no others.
  void (*write_cells)(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end, CellOutput out);
  /// Copies the points at some positions, and these for indices unless they are null. The range needs no
  /// indices.
  void (*copy_at)(const PointRange& points, std::span<const std::uint32_t> positions, const LocalOutput& out);
  /// Writes the mean of each cell's points: sums are relative to its first point, so that no digits are lost
  /// far from the origin.
  void (*set_means)(const CellPoints& cells, float* x, float* y, float* z);
  /// Writes for each cell the index of the point nearest to the mean of its points, the first of several.
  void (*find_middles)(const CellPoints& cells, std::uint32_t* out);
  /// own: 1 for each point of the object; marks: bin + own stride(), or no_mark(). There must be room for
  /// size + kPointPadding, and as many points to read.
  void (*tag_band)(const BandTags& tags, const BandPoints& points, std::int32_t* own, std::int32_t* marks);
  /// Writes z of the own points in the part, in their order; returns their number. There must be room for
  /// size + kPointPadding, and as many points to read.
  std::size_t (*keep_depths)(const BandPoints& points, const std::int32_t* own, const BandPart& part,
                             float* out);
  /// Writes the positions among the points of those within the limits, ascending; returns their number. There
  /// must be room for size + kPointPadding, and as many points to read.
  std::size_t (*select_band)(const BandLimits& limits, const BandPoints& points, std::uint32_t* out);
  /// The same of the own points; room and reading as there.
  BandCounts (*select_own)(const BandLimits& limits, const BandPoints& points, const std::int32_t* own,
                           std::uint32_t* out);
  /// Widens [low, high] to hold f of the own points within the limits. Reading as for select_band.
  void (*extend_own)(const BandLimits& limits, const BandPoints& points, const std::int32_t* own, float& low,
                     float& high);
  /// Sets marked[marks[k]] to 1 for each point k within the limits. Reading as for select_band.
  void (*mark_band)(const BandLimits& limits, const BandPoints& points, const std::int32_t* marks,
                    std::uint8_t* marked);
};

/// floor(coordinate * per_cell) by truncation, which unlike std::floor needs no call and goes into vectors.
[[nodiscard]] inline int cell_index(float coordinate, float per_cell) {
  const float scaled = coordinate * per_cell;
  const int truncated = static_cast<int>(scaled);
  return truncated - (static_cast<float>(truncated) > scaled ? 1 : 0);
}

[[nodiscard]] const PointKernels& portable_kernels();
/// Null where the processor or the compiler's target has no AVX2.
[[nodiscard]] const PointKernels* avx2_kernels();
/// The faster of what is there.
[[nodiscard]] const PointKernels& point_kernels();

}  // namespace graspd
