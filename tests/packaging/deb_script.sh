#!/bin/bash
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# What deb_test.py runs in the booted container, as root: starts the installed daemon, uses it, purges it, and writes
# what it sees as key=value.
set -u
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0' DEBIAN_FRONTEND=noninteractive

show() { systemctl show --property="$1" --value graspd; }

ip link set lo up
ip route add 239.0.0.0/8 dev lo src 127.0.0.1
echo "enabled=$(systemctl is-enabled graspd)"
echo "state_before=$(show ActiveState)"
systemctl start graspd
echo "state=$(show ActiveState)"
echo "health=$(graspd-status --once --format json --timeout 20 | grep -c '"utime"')"
graspd-listen --format json --count 3 --timeout 30 >/tmp/answers 2>/dev/null &
listener=$!
sleep 1
graspd-simulate --width 320 --frames 4 --rate 2 2>/dev/null
wait $listener
echo "answers=$(wc -l </tmp/answers)"
echo "handles=$(grep -o '"score"' /tmp/answers | wc -l)"
rm /tmp/answers

# A completion does what its program's options are.
echo "completion=$(bash -c '. /usr/share/bash-completion/completions/graspd-listen
  COMP_WORDS=(graspd-listen --format j) COMP_CWORD=2; _graspd_listen; echo "${COMPREPLY[*]}"')"

# What users leave behind: changed settings, a key, the unit enabled.
echo "# mine" >>/etc/graspd/graspd.yaml
graspd-keygen /etc/graspd/key
systemctl --quiet enable graspd
systemctl reload graspd
echo "state_reloaded=$(show ActiveState)"
dpkg --remove graspd-bench graspd >/dev/null
echo "state_removed=$(systemctl is-active graspd)"
echo "settings_kept=$(grep -c mine /etc/graspd/graspd.yaml)"
apt-get purge -q -y --autoremove graspd >/dev/null
echo "purged=$(dpkg-query --show --showformat '${Status}' graspd 2>/dev/null)"
journalctl --unit graspd --output cat --no-pager
