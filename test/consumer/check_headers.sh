#!/bin/sh
# check_headers.sh PREFIX: each installed header compiles by itself in every standard that controller/README.md promises.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for header in $(cd "$1/include" && find limphome -name '*.h'); do
    printf '#include <%s>\nextern int nothing;\n' "$header" >"$work/includes.h"
    ${CC:-cc} -x c -std=gnu89 -Wall -Wextra -Werror -fsyntax-only -I"$1/include" "$work/includes.h"
    for standard in c99 c11 c17; do
        ${CC:-cc} -x c -std=$standard -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$1/include" "$work/includes.h"
    done
    for standard in c++11 c++17 c++20; do
        ${CXX:-c++} -x c++ -std=$standard -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$1/include" "$work/includes.h"
    done
done
echo "$(find "$1/include/limphome" -name '*.h' | wc -l) headers"
