#!/bin/sh
# check_programs.sh SOURCE BUILD: installs the programs of a build with their files and runs them (run_programs.sh) in new
# namespaces of network and mounts. Exit 77, skipped, where those are not permitted.
set -eu
for namespaces in "unshare -rnm" "unshare -nm" ""; do
    if [ -z "$namespaces" ]; then
        echo "namespaces of network and mounts are not permitted here"
        exit 77
    elif $namespaces true 2>/dev/null; then
        break
    fi
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$2" --prefix "$work/prefix" --component programs
cp "$(dirname "$0")/run_programs.sh" "$work"
$namespaces env -i PATH="$work/prefix/bin:/usr/sbin:/usr/bin:/sbin:/bin" sh "$work/run_programs.sh" "$1" "$2" "$work"
