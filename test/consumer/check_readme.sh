#!/bin/sh
# check_readme.sh PREFIX: the example in controller/README.md compiles without a warning, and learns.
set -eu
readme=$(dirname "$(readlink -f "$0")")/../../controller/README.md
PKG_CONFIG_PATH=$(find "$1" -type d -name pkgconfig)
export PKG_CONFIG_PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -n '/^```c$/,/^```$/ { /^```/ d; p }' "$readme" >"$work/example.c"
# shellcheck disable=SC2046,SC2086 # several words
${CC:-cc} ${CFLAGS-} -std=c11 -Wall -Wextra -Wpedantic -Werror "$work/example.c" \
    $(pkg-config --cflags --libs limphome) -o "$work/example"
"$work/example" | tee "$work/output"
awk '{ sub(":", "", $2); steps[$2] = $3 } END { exit !(steps[128] > 0 && steps[128] < 25 && steps[1] > 100) }' "$work/output"
