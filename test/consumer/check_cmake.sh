#!/bin/sh
# check_cmake.sh PREFIX: a project of its own finds the library by find_package, but not a newer one.
set -eu
project=$(dirname "$(readlink -f "$0")")/project
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake -S "$project" -B "$work" -DCMAKE_PREFIX_PATH="$1"
cmake --build "$work"
"$work/consumer"
"$work/consumer_cpp"

if cmake -S "$project" -B "$work/newer" -DCMAKE_PREFIX_PATH="$1" -DLIMPHOME_WANTED=99.0 >/dev/null 2>&1; then
    echo "version 99 was found"
    exit 1
fi
