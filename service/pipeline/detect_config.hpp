// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The settings of the whole method, one struct a stage.
#pragma once

#include "service/pipeline/workspace_filter.hpp"

namespace graspd {

struct DetectConfig {
  WorkspaceFilterConfig workspace;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("workspace", self.workspace, "which points are looked at");
  }
};

}  // namespace graspd
