// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What becomes of memory that is freed.
#pragma once

namespace graspd {

/// Keeps freed memory for the next frame instead of giving it back to the kernel, which would have to fill
/// each page with zeros anew, a tenth of a frame's time. Resident memory stays at what the largest frames
/// need. Before the first thread starts. Does nothing where the C library is not glibc.
void keep_freed_memory();

}  // namespace graspd
