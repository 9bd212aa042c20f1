#!/bin/sh
# check_install.sh BUILD PREFIX: installs the library of a build, without what it has for itself.
set -eu
rm -rf "$2"
cmake --install "$1" --prefix "$2" --component limphome
test -f "$2/include/limphome/limphome.h"
test ! -e "$2/include/limphome/base/lanes.h"
test ! -e "$2/bin"
