#!/bin/sh
# check_unhardened.sh COMPILER: check_hardened.sh notices each thing that is missing, and that alone.
set -eu
compiler=$1
check=$(dirname "$(readlink -f "$0")")/check_hardened.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/program.c" <<'END'
#include <stdio.h>
#include <string.h>
int main(int argc, char **argv) {
    char copy[64];
    memcpy(copy, argv[0], (size_t)argc); /* a size that is not known before */
    return printf("%s\n", copy) < 0;
}
END
case $(uname -m) in
    x86_64) branches=-fcf-protection=full ;;
    *) branches= ;;
esac

# expect MISSING OPTION...: of a program built with the options behind all that harden, so much is said to be missing
expect() {
    missing=$1
    shift
    # shellcheck disable=SC2086 # no word where there are none
    "$compiler" -O2 -fPIE -pie -fstack-protector-strong -D_FORTIFY_SOURCE=2 $branches -Wl,-z,relro,-z,now,-z,noexecstack \
        "$work/program.c" -o "$work/program" "$@" 2>"$work/errors" || { cat "$work/errors"; exit 1; }
    found=$("$check" "$work/program" fortified | sed 's/.*://')
    if [ "$found" != "${missing:+ }$missing" ]; then
        echo "$*: said to be missing:$found; expected: $missing"
        exit 1
    fi
}

expect ""
expect pie -fno-PIE -no-pie
expect relro -Wl,-z,norelro
expect bind_now -Wl,-z,lazy
expect noexecstack -Wl,-z,execstack
expect stack_protector -fno-stack-protector
expect fortify -U_FORTIFY_SOURCE
if [ -n "$branches" ]; then
    expect cet -fcf-protection=none
fi
expect no_text_relocations_or_run_path -Wl,-rpath,/tmp
