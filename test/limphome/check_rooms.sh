#!/bin/sh
# check_rooms.sh LIBRARY: each room of the library includes only itself and those before it.
set -eu
cd "$1"
before="base"
for room in base body task learning; do
    before="$before|$room"
    if grep -nE '#include "' "$room"/*.[ch] | grep -vE "#include \"limphome/($before)/"; then
        echo "$room/ may include only $before"
        exit 1
    fi
done
test "$(ls -d -- */ | tr -d '/\n')" = "basebodylearningtask" # no room is left out above
