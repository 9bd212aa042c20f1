#!/bin/sh
# check_hardened.sh PROGRAM [fortified]: the program has what cmake/hardening.cmake gives; names each thing that is missing.
set -eu
program=$1
LC_ALL=C
export LC_ALL
header=$(readelf -hW "$program")
segments=$(readelf -lW "$program")
dynamic=$(readelf -dW "$program")
symbols=$(nm -D --undefined-only "$program")
missing=""

# expect WHAT TEXT PATTERN: a line of the text is like the pattern
expect() {
    if ! echo "$2" | grep -qE "$3"; then
        missing="$missing $1"
    fi
}

expect pie "$header" '^ *Type: +DYN'
expect relro "$segments" '^ *GNU_RELRO '
expect bind_now "$dynamic" '\((FLAGS|BIND_NOW)\).*BIND_NOW'
expect noexecstack "$segments" '^ *GNU_STACK .* RW +0x'
expect stack_protector "$symbols" ' __stack_chk_fail(@|$)'
if [ "${2-}" = fortified ]; then
    expect fortify "$symbols" ' __[a-z]*(cpy|printf|move|set|cat)_chk(@|$)'
fi
case $(uname -m) in
    x86_64) expect cet "$(objdump -d --no-show-raw-insn --disassemble=main "$program")" '^ .*\sendbr64' ;;
esac
# no addresses that are written into code, and no libraries from wherever somebody puts them
if echo "$dynamic" | grep -qE '\((TEXTREL|RPATH|RUNPATH)\)'; then
    missing="$missing no_text_relocations_or_run_path"
fi

if [ -n "$missing" ]; then
    echo "$program is not hardened:$missing"
    exit 1
fi
