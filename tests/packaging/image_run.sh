#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# What image_test.sh runs in a network of its own: the daemon and the simulated camera in containers, the listener outside.
set -euo pipefail
bin=build/bin
folder=build/packaging
run=(podman run --rm --network host --no-healthcheck --read-only --cap-drop all --security-opt no-new-privileges
  --env "LCM_DEFAULT_URL=$LCM_DEFAULT_URL")

fail() { printf 'image_run.sh: %s\n' "$*" >&2; cat "$folder"/container-*.log >&2; exit 1; }
ok() { printf 'ok: %s\n' "$*"; }

umount /sys/fs/cgroup/unified 2>/dev/null || true
"${run[@]}" --name graspd-test localhost/graspd >"$folder/container-daemon.log" 2>&1 &
daemon=$!
trap 'podman rm --force --time 1 graspd-test graspd-test-view >/dev/null 2>&1 || true' EXIT

"$bin/graspd-status" --once --format json --timeout 60 >/dev/null || fail "no status arrives from the container"
ok "status outside of the container"
podman exec graspd-test graspd-status --once --format json >/dev/null || fail "the health check fails"
ok "the health check's command"
user=$(podman exec graspd-test sh -c 'cat /proc/1/status' | awk '$1 == "Uid:" { print $2 }')
[ "$user" -gt 0 ] || fail "the daemon runs as root"
ok "the daemon's user is $user"

"$bin/graspd-listen" --format json --count 3 --timeout 60 >"$folder/handles.jsonl" &
listener=$!
sleep 1
"${run[@]}" --entrypoint graspd-simulate localhost/graspd --type depth --width 320 --rate 2 --frames 6 \
  >"$folder/container-camera.log" 2>&1 || fail "the camera's container failed"
wait "$listener" || fail "the listener got no three lists"
grep -q '"score"' "$folder/handles.jsonl" || fail "lists without a handle"
ok "$(wc -l <"$folder/handles.jsonl") lists with $(grep -o '"score"' "$folder/handles.jsonl" | wc -l) handles outside of the container"

# The page comes from a container, too.
"${run[@]}" --name graspd-test-view --entrypoint graspd-view localhost/graspd >"$folder/container-view.log" 2>&1 &
page=
for _ in $(seq 100); do
  page=$(python3 -c 'import urllib.request; print(urllib.request.urlopen("http://127.0.0.1:8090/").read().decode())' 2>/dev/null || true)
  if [ -n "$page" ]; then break; fi
  sleep 0.2
done
case "$page" in *"<script"*) ok "the view's page" ;; *) fail "no page from the viewer's container" ;; esac
podman stop --time 10 graspd-test-view >/dev/null

podman stop --time 10 graspd-test >/dev/null
wait "$daemon" || fail "the daemon ended with $? on SIGTERM"
ok "ends well on SIGTERM"
