# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# ./run demo: a simulated camera, the daemon, a logger and a listener as processes of their own over UDP. Sourced by ./run.

demo_seconds=15 demo_log=build/demo demo_seed=1 demo_private=no
demo_group=239.255.76.67
demo_wanted_buffer=4194304  # what the programs ask the kernel for [bytes]
demo_pids=()

demo_options() {
  while [ $# -gt 0 ]; do
    case "$1" in
      --seconds) demo_seconds=${2:-}; shift ;;
      --forever) demo_seconds=forever ;;
      --log) demo_log=${2:-}; shift ;;
      --seed) demo_seed=${2:-}; shift ;;
      --private) demo_private=yes ;;
      *) usage_error "demo: $1?" ;;
    esac
    shift || usage_error "demo: the last option lacks its value"
  done
  [[ $demo_seconds =~ ^([1-9][0-9]*|forever)$ ]] || usage_error "demo: --seconds wants a whole number above 0"
  [[ $demo_seed =~ ^[0-9]+$ ]] || usage_error "demo: --seed wants a whole number"
  [ -n "$demo_log" ] || usage_error "demo: --log wants a folder"
}

# Whether a multicast packet comes back on this machine. With a time to live of 0 it cannot leave it.
demo_loopback_works() {
  python3 - "$demo_group" 2>/dev/null <<'EOF'
import socket, sys
group = sys.argv[1]
receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
receiver.bind((group, 0))
receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + bytes(4))
receiver.settimeout(1)
sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
sender.sendto(b"graspd", receiver.getsockname())
sys.exit(receiver.recv(16) != b"graspd")
EOF
}

# The command that starts a process in a network of its own; nothing where that is not allowed.
demo_unshare() {
  local command
  for command in "unshare --net" "unshare --map-root-user --net"; do
    if $command true 2>/dev/null; then printf '%s' "$command"; return; fi
  done
}

# Goes on in a private network namespace when the machine's network does not carry multicast, or when asked to.
demo_enter_network() {
  local unshare
  [ "${GRASPD_DEMO_NETWORK:-}" != private ] || return 0
  # Read out here: a network namespace does not show it. The limit holds inside, too.
  demo_buffer=$(cat /proc/sys/net/core/rmem_max 2>/dev/null || echo "$demo_wanted_buffer")
  export GRASPD_DEMO_BUFFER=$demo_buffer
  if [ "$demo_private" = no ]; then
    if demo_loopback_works; then return 0; fi
    say "This machine has no usable multicast route. To give it one:  sudo ip route add 239.0.0.0/8 dev lo"
  fi
  unshare=$(demo_unshare)
  [ -n "$unshare" ] || fail "and a private network namespace is not allowed here."
  say "Going on in a private network namespace: other programs of this machine do not see the demo."
  export GRASPD_DEMO_NETWORK=private
  # shellcheck disable=SC2016,SC2086  # $unshare is a command with options; the inner script's own arguments
  exec $unshare sh -c 'ip link set lo up && ip route add 239.0.0.0/8 dev lo && exec "$@"' sh ./run demo "$@"
}

# Frame size that the kernel's receive buffer takes: a message that does not fit is lost without a word.
demo_frame_size() {
  demo_size=(--width 640 --height 480)
  if [ "${GRASPD_DEMO_BUFFER:-$demo_wanted_buffer}" -lt 1048576 ]; then
    demo_size=(--width 320 --height 240)
    say "net.core.rmem_max is $GRASPD_DEMO_BUFFER bytes, too little for VGA frames; the demo takes 320 x 240."
    say "To have it larger:  sudo sysctl -w net.core.rmem_max=$demo_wanted_buffer"
  fi
}

demo_start() {
  "$@" &
  demo_pids+=($!)
}

# Ends the processes that still run, the youngest first, and waits for each.
demo_stop() {
  local i
  for ((i = ${#demo_pids[@]} - 1; i >= 0; --i)); do demo_end "${demo_pids[i]}"; done
  demo_pids=()
}

demo_end() {
  kill -TERM "$1" 2>/dev/null || true
  wait "$1" 2>/dev/null || true
}

# Waits until so many sockets listen on LCM's port.
demo_await_sockets() {
  local i
  for ((i = 0; i < 200; ++i)); do
    [ "$(awk '$2 ~ /:1DF3$/' /proc/net/udp | wc -l)" -lt "$1" ] || return 0
    sleep 0.05
  done
  fail "the programs do not come up; see the messages above"
}
