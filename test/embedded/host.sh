#!/usr/bin/env bash
# host.sh BUILD: records a run of controller and simulator for each kind of learner, takes its decisions again with the
# library alone, and compares with what the controller said. Leaves recording.bin and what a board must make of it in
# BUILD/test/embedded/LEARNER.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
export LIMPHOME_BUILD=$1
results=$1/test/embedded

# record LEARNER CONFIG EPISODES DECISIONS OPTION...: with short episodes and a low bound on tilt, so that every outcome and
# many resets are among the decisions
record() {
    mkdir -p "$results/$1"
    cd "$results/$1"
    rm -rf run
    "$root/scripts/train" --quiet --no-figures --out run --config "$root/config/$2" --episodes "$3" \
        --set episode.tumble_tilt_rad=0.3 --set episode.reset_every=10 --set simulator.time_step_s=0.01 "${@:5}"
    "$results/record" run "$4"
    "$results/replay"
    cmp published.bin decisions.bin
    echo "$1:"
    cut -d, -f2 run/episodes.csv | sort | uniq -c
}

record q_learning paper.ini 900 10000 --set episode.goal_distance_m=1.0 --set episode.step_limit=200
record planner default.ini 250 1000 --set episode.goal_distance_m=1.0 --set episode.step_limit=9 --set planner.sweeps=1
cd "$results"
./elementary_bits
