// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-replay's commands besides replaying itself.
#pragma once

namespace graspd {

/// Each takes the command line from its own name on, and returns the exit code.
int plan_main(int argc, char** argv);     ///< logs -> shards
int shard_main(int argc, char** argv);    ///< works on one shard
int missing_main(int argc, char** argv);  ///< shards that are not done
int merge_main(int argc, char** argv);    ///< shards -> log
int table_main(int argc, char** argv);    ///< log -> tables
int play_main(int argc, char** argv);     ///< log -> LCM

}  // namespace graspd
