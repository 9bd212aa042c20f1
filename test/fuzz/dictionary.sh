#!/bin/sh
# Dictionary for fuzz_settings: the odd values of a file, then every section, key and word as the program tells them.
# Usage: dictionary.sh PROGRAM VALUES OUT
set -eu
{
    cat "$2"
    "$1" --help-settings | awk -F ' *[|] *' '
        /^## / { print "\"" substr($0, 4) "\"" }
        /^[|] `/ {
            gsub("`", "", $2)
            print "\"" $2 " = \""
            if (sub("^one of: ", "", $4)) {
                count = split($4, words, " ")
                for (i = 1; i <= count; i++) {
                    print "\"" words[i] "\""
                }
            }
        }' | sort -u
} >"$3"
