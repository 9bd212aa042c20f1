#!/bin/sh
# check_readme.sh PREFIX: the example in controller/README.md has 40 lines or fewer, compiles without a warning, prints
# what is said there, and learns.
set -eu
readme=$(dirname "$(readlink -f "$0")")/../../controller/README.md
PKG_CONFIG_PATH=$(find "$1" -type d -name pkgconfig)
export PKG_CONFIG_PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -n '/^```c$/,/^```$/ { /^```/ d; p }' "$readme" >"$work/example.c"
sed -n '/^```text$/,/^```$/ { /^```/ d; p }' "$readme" >"$work/expected"
test "$(wc -l <"$work/example.c")" -le 40
# shellcheck disable=SC2046,SC2086 # several words
${CC:-cc} ${CFLAGS-} -std=c11 -Wall -Wextra -Wpedantic -Werror "$work/example.c" \
    $(pkg-config --cflags --libs limphome) -o "$work/example"
"$work/example" | tee "$work/output"
diff "$work/expected" "$work/output"
awk '$1 == "episode" { sub(":", "", $2); steps[$2] = $3; off[$2] = $5 < 0 ? -$5 : $5 }
     END { exit !(steps[1] > 100 && steps[128] > 0 && steps[128] < 25 && off[128] < 0.1 && off[128] < off[1]) }' \
    "$work/output"
