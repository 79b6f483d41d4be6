#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds docker/Dockerfile and runs the image without an engine: small, not root, healthy, and a listener outside of it gets
# handles. As root; build/packages/graspd_*.deb goes in, or with GRASPD_COMPILE_IMAGE=yes everything is compiled inside.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
folder=$(readlink -f build)/packaging
max_bytes=250000000
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0'

fail() { printf 'image_test.sh: %s\n' "$*" >&2; exit 1; }
ok() { printf 'ok: %s\n' "$*"; }

# Storage and settings of this test's own, so that it neither needs nor touches those of the machine.
set_up_storage() {
  mkdir -p "$folder/storage"
  cat >"$folder/containers.conf" <<'END'
[containers]
default_ulimits = ["nofile=4096:4096", "nproc=4096:4096"]
[engine]
cgroup_manager = "cgroupfs"
events_logger = "file"
END
  cat >"$folder/storage.conf" <<END
[storage]
driver = "overlay"
graphroot = "$folder/storage"
runroot = "$folder/storage-run"
END
  export CONTAINERS_CONF=$folder/containers.conf CONTAINERS_STORAGE_CONF=$folder/storage.conf
}

# The base image from the mirrors that this machine uses: no registry of images is asked.
make_base() {
  if podman image exists localhost/debian:bookworm-slim; then return; fi
  python3 -B - "$folder/slim.tar" <<'END'
import pathlib, sys
sys.path.insert(0, "tests/packaging")
import debian_root
# As Debian's own slim image: without documents and translations.
slim = [f"--dpkgopt=path-exclude=/usr/share/{part}/*" for part in ("man", "locale", "doc", "info", "lintian")]
debian_root.make_tar(pathlib.Path(sys.argv[1]), ["ca-certificates"], *slim)
END
  podman import --quiet "$folder/slim.tar" localhost/debian:bookworm-slim >/dev/null
}

# An image with /packages alone, in place of the stage that compiles.
make_packages_image() {
  local context
  context=$(mktemp -d)
  cp build/packages/*.deb "$context"
  printf 'FROM scratch\nCOPY *.deb /packages/\n' >"$context/Dockerfile"
  buildah bud --quiet --isolation chroot --format docker -t localhost/graspd-packages "$context" >/dev/null
  rm -r "$context"
}

build_image() {
  local recipe=docker/Dockerfile
  if [ "${GRASPD_COMPILE_IMAGE:-no}" != yes ]; then
    make_packages_image
    recipe=$folder/Dockerfile
    sed 's,^FROM build AS packages$,FROM localhost/graspd-packages AS packages,' docker/Dockerfile >"$recipe"
    grep -q '^FROM localhost/graspd-packages' "$recipe" || fail "docker/Dockerfile has no stage 'packages' any more"
  fi
  buildah bud --isolation chroot --format docker --pull-never -f "$recipe" -t localhost/graspd . \
    >"$folder/image.log" 2>&1 || { tail -30 "$folder/image.log" >&2; fail "the image does not build"; }
}

check_image() {
  local bytes user health
  bytes=$(podman image inspect --format '{{.Size}}' localhost/graspd)
  [ "$bytes" -lt "$max_bytes" ] || fail "the image has $bytes bytes, $max_bytes at most"
  ok "image of $((bytes / 1000000)) MB"
  user=$(podman image inspect --format '{{.Config.User}}' localhost/graspd)
  [ "$user" = graspd ] || fail "the image's user is '$user'"
  health=$(podman image inspect --format '{{.HealthCheck.Test}}' localhost/graspd)
  case "$health" in *graspd-status*) ok "health check: $health" ;; *) fail "health check: '$health'" ;; esac
}

run_outside() {
  unshare --net --mount sh -c 'ip link set lo up && ip route add 239.0.0.0/8 dev lo && exec "$@"' sh "$@"
}

set_up_storage
make_base
build_image
check_image
run_outside tests/packaging/image_run.sh
docker-compose -f docker/compose.yaml --profile simulation --profile log --profile view config -q
ok "compose.yaml"
