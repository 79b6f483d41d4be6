// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The portable form of the kernels that a frame is filtered and its surfaces are found with. Included by it
// and by point_kernels.cpp alone.
#pragma once
#include "service/pipeline/point_kernels.hpp"

namespace graspd::portable {

std::size_t test_workspace(const WorkspaceTest& test, const float* x, const float* y, const float* z,
                           std::size_t n, std::uint8_t* masks);
void copy_chosen(const float* x, const float* y, const float* z, const std::uint8_t* masks, std::size_t n,
                 const ChosenPoints& out);
std::size_t copy_inside(const float (&min)[3], const float (&max)[3], const PointRange& points,
                        std::span<const PointSpan> spans, const LocalOutput& out);
int count_on_plane(const PlaneTest& test, const PlaneSample& sample);
void solve_planes(const MomentLanes& moments, NormalLanes& normals);
std::size_t count_bent(const NormalArrays& normals, std::uint32_t s, float limit,
                       const std::uint32_t* indices, std::size_t n);
FoundLinks find_links(const LinkTest& test, const LinkPlace& place, const std::uint32_t* indices,
                      std::size_t n, std::uint32_t* out);
bool any_other(const std::int32_t* values, std::int32_t value, const std::uint32_t* indices, std::size_t n);
std::size_t list_above(const std::int32_t* values, std::int32_t limit, const std::uint32_t* indices,
                       std::size_t n, std::uint32_t* out);
std::size_t list_members(const std::int32_t* values, std::size_t n, std::uint32_t* out);
std::size_t list_unmarked(const std::uint8_t* marks, std::size_t n, std::uint32_t* out);
void first_few(const float* v, std::size_t n, bool largest, float (&out)[kFew]);

// What points are brought into order with.
std::size_t count_changes(const std::uint32_t* keys, std::size_t n);
void write_runs(const std::uint32_t* keys, std::size_t begin, std::size_t end, CellRun<std::uint32_t>* out,
                std::size_t num);
CellCounts count_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end);
void write_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end, CellOutput out);
void copy_at(const PointRange& points, std::span<const std::uint32_t> positions, const LocalOutput& out);
void set_means(const CellPoints& cells, float* x, float* y, float* z);
void find_middles(const CellPoints& cells, std::uint32_t* out);

// What a depth image is rendered with.
void sum_directions(const ViewImage& view, const PointRange& points, DirectionSums& sums);
void extend_slopes(const ViewImage& view, const PointRange& points, SlopeBounds& bounds);
void find_pixels(const ViewImage& view, const PointRange& points, std::int32_t* pixels, float* depths);

}  // namespace graspd::portable
