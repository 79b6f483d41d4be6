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

# How many messages it has refused so far, by its own status.
refused() {
  sleep 1
  graspd-status --once --format json --timeout 20 | tr -d ' ' | grep -o '"refused":[0-9]*' | head -n 1 | cut -d : -f 2
}

# Three messages that it would refuse, from another host to our address.
send_from_other() {
  for _ in 1 2 3; do
    nsenter --target "$other" --net bash -c 'printf "LC02\0\0\0\1GRASPD_CLOUD\0junk" > /dev/udp/10.78.0.1/7667'
  done
}

# systemd-nspawn mounts the controllers of cgroup version 1 for reading alone; systemd looks for them as it starts.
if [ -d /sys/fs/cgroup/memory ]; then
  mount -o remount,bind,rw,nosuid,nodev,noexec /sys/fs/cgroup/memory
  systemctl daemon-reexec
fi
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

unshare --net sleep 1000 &
other=$!
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/self/ns/net)" ]; do sleep 0.1; done
ip link add veth0 type veth peer name veth1 netns "$other"
ip address add 10.78.0.1/24 dev veth0
ip link set veth0 up
nsenter --target "$other" --net ip address add 10.78.0.2/24 dev veth1
nsenter --target "$other" --net ip link set veth1 up
send_from_other
echo "foreign_refused=$(refused)"
printf 'LC02\0\0\0\1GRASPD_CLOUD\0junk' > /dev/udp/127.0.0.1/7667
echo "local_refused=$(refused)"
mkdir -p /run/systemd/system/graspd.service.d
printf '[Service]\nIPAddressAllow=any\n' > /run/systemd/system/graspd.service.d/open.conf
systemctl daemon-reload
systemctl restart graspd
send_from_other
echo "foreign_refused_without_rule=$(refused)"
rm /run/systemd/system/graspd.service.d/open.conf
systemctl daemon-reload
systemctl restart graspd
kill $other

echo "memory_current=$(show MemoryCurrent)"
systemctl set-property --runtime graspd MemoryMax=24M
pid_before=$(show MainPID)
graspd-simulate --width 640 --frames 3 --rate 2 2> /dev/null
wait_for_restart 1
echo "restarts_after_memory=$(show NRestarts)"
if [ "$(show MainPID)" != "$pid_before" ] && journal | grep -q 'status=9/KILL'; then echo "memory_kill=yes"; fi
systemctl set-property --runtime graspd MemoryMax=4G
echo "answers_after_memory=$(answers)"

start=$(date +%s%N)
systemctl stop graspd
echo "stop_ms=$((($(date +%s%N) - start) / 1000000))"
echo "stop_state=$(show ActiveState)"
echo "stop_result=$(show Result)"
echo "--- journal"
journal
