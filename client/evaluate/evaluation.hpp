// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a judge found out about the handles of one frame. Figures are computed from this alone, so that
// judges with different knowledge (labels, exact solids) are measured in the same way.
#pragma once
#include <string>
#include <vector>

#include "service/pipeline/handle.hpp"

namespace graspd {

struct JudgedHandle {
  Handle handle;
  int object = -1;      ///< that it would hold, also when it fails; -1: none
  bool valid = false;   ///< it would hold that object, and hit nothing
  std::string failure;  ///< why not, lower_snake; empty when valid
};

struct JudgedFrame {
  std::string name;
  std::string category;               ///< empty: none
  std::vector<int> objects;           ///< that count for recall, each once
  std::vector<JudgedHandle> handles;  ///< best first
};

}  // namespace graspd
