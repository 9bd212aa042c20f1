#!/usr/bin/env bash
# board.sh PROCESSOR BUILD_TYPE FOLDER HOST: builds for a board in FOLDER and runs its tests under QEMU; HOST holds the
# host's results. Exit 77, skipped, without cross compiler or emulator.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
for program in arm-none-eabi-gcc qemu-system-arm; do
    if ! command -v $program; then
        echo "there is no $program: install gcc-arm-none-eabi, libnewlib-arm-none-eabi and qemu-system-arm"
        exit 77
    fi
done
cmake -S "$root" -B "$3" -G Ninja --toolchain "$root/cmake/$1.cmake" -DCMAKE_BUILD_TYPE="$2" -DLIMPHOME_WERROR=ON \
    -DLIMPHOME_HOST_RESULTS="$4" -Wno-dev
cmake --build "$3"
ctest --test-dir "$3" --verbose
