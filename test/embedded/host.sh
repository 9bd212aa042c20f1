#!/usr/bin/env bash
# host.sh BUILD: records a run of controller and simulator, takes its decisions again with the library alone, and compares
# with what the controller said. Leaves recording.bin and what a board must make of it in BUILD/test/embedded.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$1
cd "$build/test/embedded"

# short episodes and a low bound on tilt, so that every outcome and many resets are among the decisions
rm -rf run
LIMPHOME_BUILD=$build "$root/scripts/train" --quiet --out run --config "$root/config/paper.ini" --episodes 500 \
    --set episode.goal_distance_m=1.0 --set episode.tumble_tilt_rad=0.3 --set episode.reset_every=10 \
    --set episode.step_limit=200 --set simulator.time_step_s=0.01
./record run
./replay
./elementary_bits
cmp published.bin decisions.bin
cut -d, -f2 run/episodes.csv | sort | uniq -c
