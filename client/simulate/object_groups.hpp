// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Things that people put side by side: rows of books and boxes, piles of books.
#pragma once
#include <vector>

#include "client/simulate/object_models.hpp"

namespace graspd {

/// Standing books that touch, in a row along x; the last one often leans against the others.
[[nodiscard]] std::vector<ObjectModel> make_book_row(Rng& rng);

/// Boxes that touch, in a row along x.
[[nodiscard]] std::vector<ObjectModel> make_box_row(Rng& rng);

/// Lying books, each on the one below, a little turned.
[[nodiscard]] std::vector<ObjectModel> make_book_pile(Rng& rng);

}  // namespace graspd
