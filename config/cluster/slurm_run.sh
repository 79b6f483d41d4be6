#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs what is missing of a plan on Slurm, then merges: slurm_run.sh PLAN OUTPUT [SBATCH-OPTION...]
# Can be stopped and started again at any time. ROUNDS (3): how often tasks that failed are tried. graspd-replay is on PATH.
set -euo pipefail
if [ $# -lt 2 ]; then
  echo "Usage: slurm_run.sh PLAN OUTPUT [SBATCH-OPTION...]" >&2
  exit 2
fi
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)
plan=$(readlink -f "$1")
output=$2
shift 2
mkdir -p "$plan/logs"

# Slurm takes arrays of up to MaxArraySize tasks, 1001 unless it is told otherwise, with numbers below that.
for _ in $(seq "${ROUNDS:-3}"); do
  missing=$(graspd-replay missing "$plan")
  [ -n "$missing" ] || break
  echo "slurm_run: shards $missing" >&2
  # What fails is missing in the next round, and in the end merge says so.
  PLAN=$plan sbatch --wait --array="$missing" --output="$plan/logs/%a.out" "$@" "$here/replay.sbatch" >&2 || true
done
exec graspd-replay merge "$plan" -o "$output" --overwrite
