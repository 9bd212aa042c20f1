#!/bin/sh
# check_pkg_config.sh PREFIX: a caller is compiled with what pkg-config says.
set -eu
source=$(dirname "$(readlink -f "$0")")/project/consumer.c
PKG_CONFIG_PATH=$(find "$1" -type d -name pkgconfig)
export PKG_CONFIG_PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck disable=SC2046,SC2086 # several words
${CC:-cc} ${CFLAGS-} -std=gnu89 "$source" $(pkg-config --cflags --libs limphome) -o "$work/consumer"
"$work/consumer"
echo "limphome $(pkg-config --modversion limphome)"
