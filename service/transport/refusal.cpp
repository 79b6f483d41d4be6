// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/refusal.hpp"

namespace graspd {

std::string_view name(RefusalReason reason) {
  switch (reason) {
    case RefusalReason::kUnknownType:
      return "unknown_type";
    case RefusalReason::kTooLarge:
      return "too_large";
    case RefusalReason::kTruncated:
      return "truncated";
    case RefusalReason::kTrailingBytes:
      return "trailing_bytes";
    case RefusalReason::kBadString:
      return "bad_string";
    case RefusalReason::kBadSize:
      return "bad_size";
    case RefusalReason::kMissingField:
      return "missing_field";
    case RefusalReason::kBadField:
      return "bad_field";
    case RefusalReason::kBadCalibration:
      return "bad_calibration";
    case RefusalReason::kBadCompression:
      return "bad_compression";
    case RefusalReason::kUnsigned:
      return "unsigned";
    case RefusalReason::kForged:
      return "forged";
    case RefusalReason::kReplayed:
      return "replayed";
    case RefusalReason::kStale:
      return "stale";
  }
  return "unknown";
}

}  // namespace graspd
