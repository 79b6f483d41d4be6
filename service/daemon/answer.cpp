// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/answer.hpp"

namespace graspd {

std::string_view name(DropReason reason) {
  switch (reason) {
    case DropReason::kNewerFrame:
      return "newer_frame";
    case DropReason::kDeadline:
      return "deadline";
    case DropReason::kMemory:
      return "memory";
    case DropReason::kHeldUp:
      return "held_up";
    case DropReason::kReconfigured:
      return "reconfigured";
    case DropReason::kStopping:
      return "stopping";
  }
  return "unknown";
}

}  // namespace graspd
