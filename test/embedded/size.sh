#!/bin/sh
# size.sh ARCHIVE: flash and RAM of the library for Arm, all functions of it; at most 43 KiB of code and constants, and no
# data that could change.
set -eu
arm-none-eabi-size -t "$1" | awk '
    { print }
    $NF == "(TOTALS)" { seen = 1; bad = $1 > 43 * 1024 || $2 > 0 || $3 > 0 }
    END { exit bad || !seen }'
