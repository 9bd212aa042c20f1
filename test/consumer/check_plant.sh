#!/bin/sh
# check_plant.sh BUILD PREFIX LIBRARY: installs the plant of a build; a project of its own, the driver of a robot, finds
# it by find_package, but not in the prefix LIBRARY, which has the library alone. So does the example of a driver.
set -eu
here=$(dirname "$(readlink -f "$0")")
rm -rf "$2"
cmake --install "$1" --prefix "$2" --component plant
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake -S "$here/driver" -B "$work/build" -DCMAKE_PREFIX_PATH="$2"
cmake --build "$work/build"
test "$("$work/build/driver" memq:// "$here/../../config/smoke.ini")" = "3 states"

# the example, as docs/real_robot.md has it built
cmake -S "$here/../../examples/driver" -B "$work/example" -DCMAKE_PREFIX_PATH="$2" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON
cmake --build "$work/example"
code=0
"$work/example/limphome-can-driver" 2>"$work/usage" || code=$?
test $code = 2 && grep -q "^usage: " "$work/usage"

if cmake -S "$here/driver" -B "$work/without" -DCMAKE_PREFIX_PATH="$3" >/dev/null 2>&1; then
    echo "a plant was found that is not installed"
    exit 1
fi
