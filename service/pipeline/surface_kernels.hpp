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
int score_plane(const PlaneTest& test, const PlaneSample& sample);
void solve_planes(const MomentLanes& moments, NormalLanes& normals);
std::size_t count_bent(const NormalArrays& normals, std::uint32_t s, float limit,
                       const std::uint32_t* indices, std::size_t n);
FoundLinks find_links(const LinkTest& test, const LinkPlace& place, const std::uint32_t* indices,
                      std::size_t n, std::uint32_t* out);
bool any_other(const std::int32_t* values, std::int32_t value, const std::uint32_t* indices, std::size_t n);
std::size_t list_members(const std::int32_t* values, std::size_t n, std::uint32_t* out);
std::size_t list_unmarked(const std::uint8_t* marks, std::size_t n, std::uint32_t* out);

}  // namespace graspd::portable
