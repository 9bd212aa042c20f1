#!/bin/sh
# check_programs.sh SOURCE BUILD cmake|deb: installs the programs of a build with their files, by CMake or as a Debian package
# of them in a root of its own, and runs them (run_programs.sh) in new namespaces of network and mounts. Exit 77, skipped,
# where those are not permitted.
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
if [ "$3" = cmake ]; then
    cmake --install "$2" --prefix "$work/prefix" --component programs
else
    cpack -G DEB --config "$2/CPackConfig.cmake" -B "$work/packages"
    package=$(echo "$work"/packages/limphome_*.deb)
    dpkg-deb --info "$package"
    for library in liblcm1 libassimp5 libbullet; do
        dpkg-deb --field "$package" Depends | grep -q "$library"
    done
    mkdir -p "$work/root/var/lib/dpkg"
    $namespaces dpkg --root="$work/root" --force-depends --force-script-chrootless --log="$work/log" --install "$package"
    mv "$work/root/usr" "$work/prefix"
    test -s "$work/prefix/share/doc/limphome/copyright"
    test -e "$work/prefix/share/limphome/lcmtypes/limphome_pose.lcm"
    test -e "$work/prefix/include/limphome/limphome.h"
fi
cp "$(dirname "$0")/run_programs.sh" "$work"
$namespaces env -i PATH="$work/prefix/bin:/usr/sbin:/usr/bin:/sbin:/bin" sh "$work/run_programs.sh" "$1" "$2" "$work"
