// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/neighborhoods.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "service/pipeline/members.hpp"

namespace graspd {
namespace {

/// The nine rows of three cells around a cell. Keys ascend from cell to cell, so that each row's position
/// only moves on.
class RowCursor {
 public:
  RowCursor(const CellKeys& cells, std::size_t first_cell) : cells_(cells) {
    std::size_t i = 0;
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) offsets_[i++] = dz * cells.layer + dy * cells.row;
    for (i = 0; i < offsets_.size(); ++i) {
      const std::int64_t key = cells.keys[first_cell] + offsets_[i] - 1;
      positions_[i] = static_cast<std::size_t>(std::lower_bound(cells.keys.begin(), cells.keys.end(), key) -
                                               cells.keys.begin());
    }
  }

  /// The occupied cells around one, itself included; cells must ascend from call to call.
  std::span<PointSpan> around(std::size_t cell) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const std::int64_t center = cells_.keys[cell] + offsets_[i];
      const std::size_t begin = positions_[i] = next_at(positions_[i], center - 1);
      const std::size_t end = next_within<3>(begin, center + 2);  // three have the keys between
      spans_[n] = {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
      n += begin != end ? 1 : 0;
    }
    return {spans_.data(), n};
  }

 private:
  /// The first cell from c on with no smaller key.
  [[nodiscard]] std::size_t next_at(std::size_t c, std::int64_t key) const {
    constexpr std::size_t kMost = 7;
    while (c + kMost < cells_.num_cells() && cells_.keys[c + kMost] < key) c += kMost + 1;
    return next_within<kMost>(c, key);
  }

  /// The same among the next kMost + 1 cells, a power of two. No processor guesses which of them it is: found
  /// without a branch.
  template <std::size_t kMost>
  [[nodiscard]] std::size_t next_within(std::size_t c, std::int64_t key) const {
    const std::int64_t* keys = cells_.keys.data();
    if (c + kMost > cells_.num_cells())
      while (c < cells_.num_cells() && keys[c] < key) ++c;
    else
      for (std::size_t half = (kMost + 1) / 2; half > 0; half /= 2) c += keys[c + half - 1] < key ? half : 0;
    return c;
  }

  const CellKeys& cells_;
  std::array<std::int64_t, 9> offsets_{};
  std::array<std::size_t, 9> positions_{};
  std::array<PointSpan, 9> spans_{};
};

/// Points to look among: copies of those that are near enough to one of several points, or all.
class Candidates {
 public:
  /// wanted: points of the cloud that may be near; size: of the spans.
  void take(const PointCloud& cloud, std::span<const std::uint32_t> wanted, float radius_m,
            const PointRange& points, std::span<const PointSpan> spans, std::size_t size) {
    points_ = points;
    spans_ = spans;
    size_ = size;
    constexpr std::size_t kEnough = 3;  // points for which a copy pays
    if (wanted.size() < kEnough) return;
    if (const std::size_t room = size + 2 * kPointPadding; x_.size() < room) {
      for (RawVector<float>* v : {&x_, &y_, &z_}) v->resize(2 * room);
      index_.resize(2 * room);
    }
    float min[3], max[3];
    set_bounds(cloud, wanted, radius_m, min, max);
    const auto n = static_cast<std::uint32_t>(point_kernels().copy_inside(
        min, max, points, spans, {x_.data(), y_.data(), z_.data(), index_.data()}));
    points_ = {x_.data(), y_.data(), z_.data(), index_.data(), n};
    whole_ = {0, n};
    spans_ = {&whole_, 1};
    size_ = n;
  }

  /// Of the spans.
  [[nodiscard]] std::size_t size() const { return size_; }

  [[nodiscard]] const PointRange& points() const { return points_; }
  [[nodiscard]] std::span<const PointSpan> spans() const { return spans_; }

 private:
  /// Of a box with all that is within the radius.
  static void set_bounds(const PointCloud& cloud, std::span<const std::uint32_t> wanted, float radius_m,
                         float (&min)[3], float (&max)[3]) {
    const float* coordinates[3] = {cloud.x.data(), cloud.y.data(), cloud.z.data()};
    for (int axis = 0; axis < 3; ++axis) {
      const float* v = coordinates[axis];
      float low = v[wanted.front()], high = low;
      for (const std::uint32_t i : wanted) {
        low = std::min(low, v[i]);
        high = std::max(high, v[i]);
      }
      // A little more than the radius, for the rounding of distances.
      const float reach = 1.0001f * radius_m + 1e-6f * std::max(std::abs(low), std::abs(high));
      min[axis] = low - reach;
      max[axis] = high + reach;
    }
  }

  PointRange points_{};
  std::span<const PointSpan> spans_;
  PointSpan whole_{};
  std::size_t size_ = 0;
  RawVector<float> x_, y_, z_;
  RawVector<std::uint32_t> index_;
};

/// Lists one after the other, in blocks that stay where they are.
class ListStorage {
 public:
  /// Room for a list of so many and kPointPadding more.
  std::uint32_t* room(std::size_t most) {
    if (static_cast<std::size_t>(end_ - next_) >= most + kPointPadding) return next_;
    RawVector<std::uint32_t>& block = blocks_.emplace_back();
    block.resize(std::max(kBlock, most + kPointPadding));
    next_ = block.data();
    end_ = next_ + block.size();
    return next_;
  }
  /// Keeps a list of so many; what may be read beyond it are points until the next one is there.
  void keep(std::size_t size) {
    next_ += size;
    std::fill_n(next_, kPointPadding, 0u);
  }
  [[nodiscard]] Neighborhoods::Storage take() { return std::move(blocks_); }

 private:
  static constexpr std::size_t kBlock = 1 << 14;

  Neighborhoods::Storage blocks_;
  std::uint32_t *next_ = nullptr, *end_ = nullptr;
};

/// Working memory of one thread, kept from chunk to chunk.
struct Workspace {
  Candidates candidates;
  RawVector<std::uint32_t> wanted;  // points of the cell
  ListStorage lists;
};

/// Sets the points of a cell whose neighbourhoods are wanted.
std::span<const std::uint32_t> wanted_points(std::span<const std::uint32_t> cell,
                                             const std::pmr::vector<std::uint8_t>& skip,
                                             RawVector<std::uint32_t>& wanted) {
  if (skip.empty()) return cell;
  if (wanted.size() < cell.size()) wanted.resize(2 * cell.size());
  const std::uint8_t* skipped = skip.data();
  std::uint32_t* to = wanted.data();
  std::size_t n = 0;
  for (const std::uint32_t i : cell) {
    to[n] = i;
    n += skipped[i] == 0 ? 1 : 0;
  }
  return {to, n};
}

/// Makes the lists cell by cell: add(cell, cursor, workspace, lists) sets lists[i] for the points of a cell;
/// the cells of a chunk ascend.
template <class Add>
Neighborhoods make_lists(const CellKeys& cells, std::size_t num_points,
                         const std::pmr::vector<std::uint8_t>& skip, const Add& add) {
  RawVector<NeighborList> lists(num_points);
  std::fill(lists.begin(), lists.end(), NeighborList{});
  constexpr std::size_t kCellsPerChunk = 128;
  const std::size_t num_chunks = (cells.num_cells() + kCellsPerChunk - 1) / kCellsPerChunk;
  tbb::enumerable_thread_specific<Workspace, std::pmr::polymorphic_allocator<Workspace>> workspaces;
  tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kCellsPerChunk;
    const std::size_t end = std::min(begin + kCellsPerChunk, cells.num_cells());
    RowCursor cursor(cells, begin);
    Workspace& w = workspaces.local();
    for (std::size_t c = begin; c < end; ++c) add(c, cursor, w, lists.data());
  });
  Neighborhoods::Storage storage;
  for (Workspace& w : workspaces)
    for (RawVector<std::uint32_t>& block : w.lists.take()) storage.push_back(std::move(block));
  return {unmarked(skip, num_points), std::move(lists), std::move(storage)};
}

}  // namespace

Neighborhoods find_neighborhoods(const PointCloud& cloud, const NeighborhoodsConfig& config,
                                 const std::pmr::vector<std::uint8_t>& skip) {
  const CellOrder order = order_by_cell(cloud, config.radius_m);
  const PaddedPoints points(cloud, order.points);
  const float radius_squared = config.radius_m * config.radius_m;
  const PointKernels& kernels = point_kernels();
  const auto add = [&](std::size_t c, RowCursor& cursor, Workspace& w, NeighborList* lists) {
    const std::span<const std::uint32_t> wanted = wanted_points(order.cell(c), skip, w.wanted);
    if (wanted.empty()) return;
    const std::span<PointSpan> spans = cursor.around(c);
    std::size_t size = 0;
    for (PointSpan& span : spans) {
      span = {order.starts[span.begin], order.starts[span.end]};
      size += span.end - span.begin;
    }
    w.candidates.take(cloud, wanted, config.radius_m, points.all(), spans, size);
    for (const std::uint32_t i : wanted) {
      std::uint32_t* list = w.lists.room(w.candidates.size());
      const std::size_t n = kernels.keep_near({cloud.x[i], cloud.y[i], cloud.z[i]}, radius_squared,
                                              w.candidates.points(), w.candidates.spans(), list);
      w.lists.keep(n);
      lists[i] = {i, static_cast<std::uint32_t>(n), list};
    }
  };
  return make_lists(order, cloud.size(), skip, add);
}

Neighborhoods adjacent_points(const CellKeys& cells, const std::pmr::vector<std::uint8_t>& skip) {
  constexpr std::size_t kMost = 27;
  const auto add = [&](std::size_t c, RowCursor& cursor, Workspace& w, NeighborList* lists) {
    if (!skip.empty() && skip[c] != 0) return;
    std::uint32_t* list = w.lists.room(kMost);
    std::uint32_t n = 0;
    for (const PointSpan& span : cursor.around(c)) {
      // Three at most: there is room for what is written beyond the end.
      for (std::uint32_t k = 0; k < 3; ++k) list[n + k] = span.begin + k;
      n += span.end - span.begin;
    }
    w.lists.keep(n);
    lists[c] = {static_cast<std::uint32_t>(c), n, list};
  };
  return make_lists(cells, cells.num_cells(), skip, add);
}

}  // namespace graspd
