#!/bin/sh
# check_rooms.sh FOLDER PREFIX ROOM...: each room of the folder includes only itself and those before it, by names that
# begin with PREFIX.
set -eu
cd "$1"
prefix=$2
shift 2
rooms=$(printf '|%s' "$@")
before=""
for room in "$@"; do
    before="$before${before:+|}$room"
    if grep -nE "# *include *(\"|<$prefix(${rooms#|})/)" "$room"/*.[ch]* |
        grep -vE "# *include *\"$prefix($before)/"; then
        echo "$room/ may include only $before"
        exit 1
    fi
done
test "$(ls -d -- */ | tr -d '/')" = "$(printf '%s\n' "$@" | sort)" # no room is left out above
