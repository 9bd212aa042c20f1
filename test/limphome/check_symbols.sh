#!/bin/sh
# check_symbols.sh ARCHIVE: the library calls nothing but what a compiler needs to copy and fill memory, and holds no
# data that could change.
set -eu
archive=$1

symbols=$(nm "$archive")
defined=$(echo "$symbols" | awk 'NF == 3 { print $3 }' | sort -u)
undefined=$(echo "$symbols" | awk '$1 == "U" { print $2 }' | sort -u)
foreign=$(echo "$undefined" | grep -vxF "$defined" |
    grep -vxE 'memcpy|memset|memcmp|memmove|_GLOBAL_OFFSET_TABLE_|__(asan|ubsan|gcov|stack_chk)_[a-z0-9_]*|__mem(cpy|set|move)_chk' || true)
if [ -n "$foreign" ]; then
    echo "calls from outside the library:" $foreign
    exit 1
fi

# constants that hold addresses (.data.rel.ro) are read-only once loaded
variables=$(size -A "$archive" | awk '$1 ~ /^\.(data|bss|tdata|tbss)/ && $1 !~ /^\.data\.rel\.ro/ { sum += $2 }
                                      END { print sum + 0 }')
common=$(echo "$symbols" | awk '$2 == "C" || $1 == "C"')
# a sanitizer keeps data of its own
if ! echo "$undefined" | grep -qE '^__(asan|ubsan)_' && { [ "$variables" -ne 0 ] || [ -n "$common" ]; }; then
    echo "$variables bytes of data that could change" $common
    exit 1
fi

echo "$(echo "$defined" | grep -c '^lh_') functions, no foreign call, no variable data"
