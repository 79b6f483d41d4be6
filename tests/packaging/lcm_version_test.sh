#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# graspd with another LCM than Debian's: compiles the daemon against the library, headers and lcm-gen of the Python package
# lcm, which has them inside, and runs the integration tests that are about messages with it and the clients of build/bin:
# two versions of LCM on one bus.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
version=${1:-1.5.2}
folder=$PWD/build/packaging/lcm-$version
build=$PWD/build-lcm

ok() { printf 'ok: %s\n' "$*"; }

if ! [ -e "$folder/complete" ]; then
  rm -rf "$folder"
  python3 -m venv "$folder"
  "$folder/bin/pip" install --quiet --disable-pip-version-check --no-deps "lcm==$version"
  touch "$folder/complete"
fi
prefix=$(echo "$folder"/lib/python3*/site-packages)
chmod +x "$prefix"/bin/lcm-*

launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake --preset release -B "$build" --log-level=WARNING "${launcher[@]}" -DCMAKE_PREFIX_PATH="$prefix" \
  -DGRASPD_LCM_LIBRARY="$prefix/lib/liblcm.so" >/dev/null
grep -q "GRASPD_LCM_GEN:FILEPATH=$prefix/bin/lcm-gen" "$build/CMakeCache.txt"
grep -q "GRASPD_LCM_INCLUDE:PATH=$prefix/include" "$build/CMakeCache.txt"
ninja -C "$build" -j "${GRASPD_JOBS:-$(nproc)}" graspd | tail -1
ldd "$build/bin/graspd" | grep -F "$prefix/lib/liblcm.so" >/dev/null
ok "compiled against LCM $version"

mixed=$build/mixed
rm -rf "$mixed"
mkdir "$mixed"
ln -s "$PWD"/build/bin/graspd* "$mixed"
ln -sf "$build/bin/graspd" "$mixed/graspd"
for test in frames sources bad_input hostile signals; do
  GRASPD_BIN=$mixed python3 -B "tests/integration/${test}_test.py"
done
ok "a daemon with LCM $version serves clients with the system's"
