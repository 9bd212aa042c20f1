#!/bin/sh
# check_controller_alone.sh SOURCE: controller and plant are configured and built where what only the simulator needs is
# hidden, and without our presets a warning is no error.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/pkgconfig"
for folder in $(pkg-config --variable pc_path pkg-config | tr : ' '); do
    find "$folder" -name '*.pc' -exec ln -sf {} "$work/pkgconfig" \; 2>/dev/null || true
done
rm "$work"/pkgconfig/bullet*.pc "$work/pkgconfig/eigen3.pc"
export PKG_CONFIG_LIBDIR="$work/pkgconfig"

configure() {
    cmake -S "$1" -B "$work/$2" -G Ninja -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -DLIMPHOME_SIMULATOR="$2" \
        -DLIMPHOME_TESTS=OFF
}

if configure "$1" ON >"$work/log" 2>&1; then
    echo "the simulator's packages are not hidden"
    exit 1
fi
configure "$1" OFF
cmake --build "$work/OFF"
"$work/OFF/bin/limphome-controller" --version
test ! -e "$work/OFF/bin/limphome-simulator"
test -e "$work/OFF/simulator/plant/liblimphome_plant.a"
if grep -q -e -Werror "$work/OFF/build.ninja"; then
    echo "warnings are errors"
    exit 1
fi
