// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether LCM's UDP multicast gets through on this machine, told before LCM stalls over it.
#pragma once
#include <string>

namespace graspd {

/// Sends LCM's own self-test message to the URL's group, time to live 0, and waits for it. Throws
/// BusUnavailable whose text names the URL, the reason and the remedy: at once without a route, after two
/// seconds of silence.
void require_multicast(const std::string& url);

}  // namespace graspd
