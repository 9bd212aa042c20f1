#!/bin/sh
# run_programs.sh SOURCE BUILD WORK: hides source and build, and runs the programs installed in WORK/prefix from WORK, by
# themselves and with each other. Called by check_programs.sh in namespaces that end with it.
set -eu
for hidden in "$2" "$1"; do
    mount -t tmpfs none "$hidden"
done
ip link set lo up multicast on
ip route add 239.255.76.67/32 dev lo src 127.0.0.1
cd "$3"
test ! -e "$1/config"

for program in limphome-controller limphome-simulator limphome-pair; do
    "$program" --version
    "$program" --help | grep "usage: $program"
    "$program" --print-settings >defaults.ini
    "$program" --config smoke.ini --print-settings >resolved.ini # of the prefix, by its name
    grep -qx 'episodes = 2500' defaults.ini
    grep -qx 'episodes = 30' resolved.ini
    printf '[learning]\nepisodes = 7\n' >smoke.ini # the working directory comes first
    "$program" --config smoke.ini --print-settings | grep -x 'episodes = 7'
    rm smoke.ini
done

limphome-describe two_arm.urdf | grep '^robot two_arm: '
limphome-arrays --version | grep "^limphome-arrays "

# the default robot, then another by its name
for robot in "" "--robot two_arm.urdf"; do
    # shellcheck disable=SC2086 # several words
    set -- --config smoke.ini --set learning.episodes=2 --set episode.step_limit=20 $robot
    limphome-simulator "$@" &
    simulator=$!
    trap 'kill "$simulator"' EXIT
    timeout 60 limphome-controller "$@" --out run
    kill "$simulator"
    wait "$simulator"
    trap - EXIT
    test "$(wc -l <run/episodes.csv)" -eq 3
    test -s run/policy.lcm
    limphome-pair "$@" --out again
    cmp run/policy.lcm again/policy.lcm
    rm -r run again
done

# found there, and nowhere else
mv prefix/share elsewhere
if limphome-controller --config smoke.ini --print-settings 2>/dev/null || limphome-simulator 2>errors; then
    echo "files were found that are not installed"
    exit 1
fi
grep 'config/crawler.urdf' errors
