#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# Instructions a point, whole and stage by stage, on fixed simulated scenes and one thread, counted by callgrind. Fails when
# one is more than 5 % above the recorded figure; stages below 1 % of the whole are shown only. Three kinds of work: voxels of
# 4.5 mm, the same with the paper's own candidates (plain), and a VGA image (a pixel is a point) with the default configuration.
#   tests/benchmark/instructions.sh [--record] [PROGRAM]
#   tests/benchmark/instructions.sh --files FILE...
# --record writes instructions.csv. PROGRAM: build/bin/graspd-bench-counted unless given. --files counts on clouds of your own,
# PCD or PLY, prints the whole of each and their medians, and compares nothing.
set -euo pipefail
export LC_ALL=C
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
recorded=$here/instructions.csv

fail() { printf 'instructions.sh: %s\n' "$*" >&2; exit 1; }

# count PROGRAM FOLDER [FILE]: writes a CSV of what callgrind counted to standard output.
count() {
  local program=$1 folder=$2
  valgrind --tool=callgrind --instr-atstart=no --callgrind-out-file="$folder/counts" "$program" "${@:3}" \
    >"$folder/run" 2>"$folder/valgrind" || { cat "$folder/valgrind" >&2; fail "valgrind failed"; }
  local dumps
  mapfile -t dumps < <(find "$folder" -name 'counts.*' | sort -V)
  # One file a stage and frame; what it counts is its first "desc: Trigger: Client Request: STAGE" and its "totals:".
  awk '
    FILENAME == ARGV[1] {
      if ($1 == "points") points[$2] += $3; else print $1 "," substr($0, length($1) + 2)
      next
    }
    /^desc: Trigger: Client Request: / { name = $5 }
    /^(totals|summary): / && name != "" {
      split(name, part, "/")
      whole = part[1] "/whole"
      if (!(whole in sum)) order[++names] = whole
      if (!(name in sum)) order[++names] = name
      sum[name] += $2
      sum[whole] += $2
      name = ""
    }
    END {
      for (i = 1; i <= names; ++i) {
        split(order[i], part, "/")
        printf "%s,%.1f\n", order[i], sum[order[i]] / points[part[1]]
      }
      exit names == 0
    }' "$folder/run" "${dumps[@]}" || fail "callgrind counted nothing"
}

# Compares two such files; 1 when a figure is too high.
compare() {
  awk -F, '
    FNR == NR { before[$1] = $2; next }
    $1 ~ /^(kernels|compiler)$/ && $2 != before[$1] { printf "note: recorded with %s %s, counted with %s\n", $1, before[$1], $2 }
    $1 ~ /^(kernels|compiler)$/ { next }
    $1 ~ /\/whole$/ { whole = $2 }
    {
      known = $1 in before
      change = known && before[$1] > 0 ? 100 * ($2 / before[$1] - 1) : 0
      small = $2 < 0.01 * whole
      verdict = !known ? "not recorded" : change <= 5 ? "" : small ? "(small)" : "MORE"
      if (verdict == "MORE" || (!known && !small)) bad = 1
      printf "%-24s %10.1f %10.1f %+8.1f %%  %s\n", $1, before[$1], $2, change, verdict
    }
    END { exit bad }' "$recorded" "$1"
}

# count_on_files PROGRAM FOLDER FILE...
count_on_files() {
  local program=$1 folder=$2 file kind kinds=(voxels plain image)
  printf '%-40s' 'instructions a point'
  printf '%10s' "${kinds[@]}"
  printf '\n'
  for file in "${@:3}"; do
    rm -f "$folder"/counts*
    count "$program" "$folder" "$file" >"$folder/counted.csv"
    printf '%-40s' "$(basename "$file")"
    for kind in "${kinds[@]}"; do
      awk -F, -v whole="$kind/whole" '$1 == whole { printf "%10.1f", $2 }' "$folder/counted.csv" | tee -a "$folder/$kind"
      printf '\n' >>"$folder/$kind"
    done
    printf '\n'
  done
  printf '%-40s' median
  for kind in "${kinds[@]}"; do
    sort -n "$folder/$kind" | awk '{ v[NR] = $1 } END { printf "%10.1f", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
  done
  printf '\n'
}

record=no
if [ "${1:-}" = --record ]; then record=yes; shift; fi
files=()
if [ "${1:-}" = --files ]; then
  [ $# -gt 1 ] || fail "--files: no file is named"
  files=("${@:2}")
  set --
fi
program=${1:-$here/../../build/bin/graspd-bench-counted}
[ -x "$program" ] || fail "$program is not there; it is built where valgrind is installed"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if [ ${#files[@]} -gt 0 ]; then
  count_on_files "$program" "$folder" "${files[@]}"
  exit 0
fi
count "$program" "$folder" >"$folder/counted.csv"
if [ "$record" = yes ]; then
  cp "$folder/counted.csv" "$recorded"
  column -s, -t "$recorded"
  exit 0
fi
kernels() { awk -F, '$1 == "kernels" { print $2 }' "$1"; }
if [ "$(kernels "$recorded")" != "$(kernels "$folder/counted.csv")" ]; then
  printf 'Not compared: recorded with %s kernels, this machine has %s ones.\n' "$(kernels "$recorded")" \
    "$(kernels "$folder/counted.csv")"
  cat "$folder/counted.csv"
  exit 0
fi
printf 'instructions a point       recorded        now\n'
compare "$folder/counted.csv" || fail "more instructions than recorded; where that is meant: $0 --record"
