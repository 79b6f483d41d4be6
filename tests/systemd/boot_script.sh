#!/bin/bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# What boot_test.py runs in the container, as root: drives the unit and writes what it sees as key=value.
set -u
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0'

show() { systemctl show --property="$1" --value graspd; }
of_process() { awk -v key="$1:" '$1 == key { print $2 }' "/proc/$2/status"; }
journal() { journalctl --sync; journalctl --unit graspd --output cat --no-pager; }

# The number of answers to five small frames.
answers() {
  graspd-listen --format json --count 5 --timeout 20 > /tmp/answers 2> /dev/null &
  local listener=$!
  sleep 1
  graspd-simulate --width 160 --frames 5 --rate 2 2> /dev/null
  wait $listener
  wc -l < /tmp/answers
}

# Waits for a line in the journal, 10 s at most; how many there are then.
count_events() {
  for _ in $(seq 100); do
    if journal | grep -q "$1"; then break; fi
    sleep 0.1
  done
  journal | grep -c "$1"
}

wait_for_restart() {
  for _ in $(seq 200); do
    if [ "$(show NRestarts)" = "$1" ] && [ "$(show ActiveState)" = active ]; then return; fi
    sleep 0.1
  done
}

ip link set lo up
ip route add 239.0.0.0/8 dev lo src 127.0.0.1
mkdir -p /etc/graspd
cp /usr/share/graspd/config/graspd.yaml /etc/graspd/graspd.yaml

systemctl start graspd
pid=$(show MainPID)
echo "pid=$pid"
echo "state=$(show ActiveState)"
sleep 1
echo "status_text=$(show StatusText)"
echo "uid=$(of_process Uid "$pid")"
echo "cap_eff=$(of_process CapEff "$pid")"
echo "cap_prm=$(of_process CapPrm "$pid")"
echo "cap_bnd=$(of_process CapBnd "$pid")"
echo "no_new_privs=$(of_process NoNewPrivs "$pid")"
echo "seccomp=$(of_process Seccomp "$pid")"
echo "seccomp_filters=$(of_process Seccomp_filters "$pid")"
echo "answers=$(answers)"

sed -i 's/max_handles: 100/max_handles: 50/' /etc/graspd/graspd.yaml
systemctl reload graspd
echo "reload_taken=$(count_events config_taken)"
echo "reload_pid=$(show MainPID)"
echo "nonsense: [" > /etc/graspd/graspd.yaml
systemctl reload graspd
echo "reload_refused=$(count_events config_refused)"
echo "bad_reload_pid=$(show MainPID)"
cp /usr/share/graspd/config/graspd.yaml /etc/graspd/graspd.yaml

kill -STOP "$pid"
wait_for_restart 1
if journalctl --no-pager | grep -q 'graspd.service: Watchdog timeout'; then echo "watchdog_result=yes"; else echo "watchdog_result=no"; fi
echo "restarts=$(show NRestarts)"
echo "restarted_state=$(show ActiveState)"
echo "restarted_pid=$(show MainPID)"
echo "answers_again=$(answers)"
kill -KILL "$(show MainPID)"
wait_for_restart 2
echo "restarts_after_kill=$(show NRestarts)"

start=$(date +%s%N)
systemctl stop graspd
echo "stop_ms=$((($(date +%s%N) - start) / 1000000))"
echo "stop_state=$(show ActiveState)"
echo "stop_result=$(show Result)"
echo "--- journal"
journal
