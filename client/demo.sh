# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# ./run demo: a simulated camera, the daemon, a logger, a listener and the live view as processes of their own over UDP. Sourced by ./run.

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
    say "This machine has no usable multicast route. To give it one:  sudo ip route add 239.0.0.0/8 dev lo src 127.0.0.1"
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
  demo_width=640
  if [ "${GRASPD_DEMO_BUFFER:-$demo_wanted_buffer}" -lt 1048576 ]; then
    demo_width=320
    say "net.core.rmem_max is $GRASPD_DEMO_BUFFER bytes, too little for VGA frames; the demo takes 320 x 240."
    say "To have it larger:  sudo sysctl -w net.core.rmem_max=$demo_wanted_buffer"
  fi
}

# In a session of its own, so that Ctrl-C reaches this script alone, which then ends the programs in their order.
demo_start() {
  setsid "$@" &
  demo_pids+=($!)
}

demo_end() {
  kill -TERM "$1" 2>/dev/null || true
  wait "$1" 2>/dev/null || true
}

# Ends the programs that still run, the youngest first, and waits for each.
demo_stop() {
  local i
  for ((i = ${#demo_pids[@]} - 1; i >= 0; --i)); do demo_end "${demo_pids[i]}"; done
  demo_pids=()
}

# The log, the handles and the truth of the last demo make room for this one.
demo_prepare_folder() {
  mkdir -p "$demo_log" || fail "the log folder $demo_log cannot be made"
  demo_log=$(readlink -f "$demo_log")
  rm -f "$demo_log"/demo.lcmlog* "$demo_log"/handles.jsonl "$demo_log"/truth.jsonl
}

# The newest list on a terminal; elsewhere one list a second would do, so every tenth.
demo_show_table() {
  if [ -t 1 ]; then
    demo_start build/bin/graspd-listen --rows 8
  else
    demo_start build/bin/graspd-listen --rows 8 > >(awk 'BEGIN { RS = ""; ORS = "\n\n" } NR % 10 == 1')
  fi
}

# The page's address goes out before the pictures come; the next free port where the usual one is taken.
demo_start_view() {
  local port i
  for port in 8090 0; do
    demo_start build/bin/graspd-view --config "$demo_log/graspd.yaml" --port "$port" >"$demo_log/view-address" 2>"$demo_log/graspd-view.log"
    for ((i = 0; i < 100; ++i)); do
      if [ -s "$demo_log/view-address" ]; then break 2; fi
      kill -0 "${demo_pids[-1]}" 2>/dev/null || break
      sleep 0.1
    done
  done
  if [ ! -s "$demo_log/view-address" ]; then
    say "The live view does not start: $(cat "$demo_log/graspd-view.log")"
  elif [ "${GRASPD_DEMO_NETWORK:-}" = private ]; then
    say "The live view runs, too, but in this private network no browser reaches it."
  else
    say "Live in the browser: $(cat "$demo_log/view-address")"
  fi
}

demo_start_programs() {
  local bin=build/bin
  export LCM_DEFAULT_URL="udpm://$demo_group:7667?ttl=0"
  demo_show_table
  demo_start "$bin/graspd-listen" --format json >"$demo_log/handles.jsonl" 2>"$demo_log/graspd-listen.log"
  demo_start "$bin/graspd-log" --channel 'GRASPD_.*' --max-size 1000 "$demo_log/demo.lcmlog" 2>"$demo_log/graspd-log.log"
  printf 'lcm:\n  control_channel: GRASPD_CONTROL\n' >"$demo_log/graspd.yaml"
  demo_start "$bin/graspd" --config "$demo_log/graspd.yaml" 2>"$demo_log/graspd.log"
  # Everyone is there when the daemon's health arrives and is in the log.
  if ! "$bin/graspd-status" --format json --count 1 --timeout 20 >/dev/null || ! demo_await_log; then
    cat "$demo_log"/*.log >&2
    fail "the programs do not come up"
  fi
  demo_start_view
  demo_start "$bin/graspd-simulate" --type depth --rate 10 --new-scene-every 20 --seed "$demo_seed" \
    --width "$demo_width" --truth "$demo_log/truth.jsonl" 2>"$demo_log/graspd-simulate.log"
  demo_camera=${demo_pids[-1]}
}

demo_await_log() {
  local i
  for ((i = 0; i < 100; ++i)); do
    if [ -s "$demo_log/demo.lcmlog.00" ]; then return 0; fi
    sleep 0.1
  done
  return 1
}

# Runs until the time is over, Ctrl-C, or the camera's end.
demo_wait() {
  local limit=$demo_seconds clock
  if [ "$limit" = forever ]; then limit=infinity; fi
  sleep "$limit" &
  clock=$!
  wait -n "$clock" "$demo_camera" || true
  kill "$clock" 2>/dev/null || true
  wait "$clock" 2>/dev/null || true
}

# Gives the frames that are on their way time to be answered.
demo_await_answers() {
  local i
  for ((i = 0; i < 50; ++i)); do
    if [ "$(wc -l <"$demo_log/handles.jsonl")" -ge "$(wc -l <"$demo_log/truth.jsonl")" ]; then return; fi
    sleep 0.1
  done
}

demo_run() {
  demo_enter_network "$@"
  demo_frame_size
  demo_prepare_folder
  trap demo_stop EXIT
  trap : INT TERM  # ends the waiting, not the script
  demo_start_programs
  demo_wait
  demo_end "$demo_camera"
  demo_await_answers
  demo_stop
  say ""
  say "Summary of $demo_width x $((demo_width * 3 / 4)) frames at 10 Hz, a new scene every 2 s:"
  python3 client/demo_summary.py "$demo_log/handles.jsonl" "$demo_log/truth.jsonl" || demo_failed=yes
  say "  the log, for lcm-logplayer: $demo_log/demo.lcmlog.00"
  if [ "${demo_failed:-no}" = yes ]; then fail "not every frame was answered"; fi
}
