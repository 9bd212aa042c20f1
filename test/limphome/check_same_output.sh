#!/bin/sh
# check_same_output.sh PROGRAM...: all print the same.
set -eu
expected=$("$1")
for program; do
    actual=$("$program")
    echo "$(basename "$program"): $actual"
    if [ "$actual" != "$expected" ]; then
        exit 1
    fi
done
