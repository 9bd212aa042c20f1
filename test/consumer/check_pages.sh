#!/bin/sh
# check_pages.sh DOXYGEN FOLDER: the pages of the interface build without a warning.
set -eu
cd "$(dirname "$(readlink -f "$0")")/../.."
{
    cat controller/Doxyfile
    echo "OUTPUT_DIRECTORY = $2"
} | "$1" -
test -f "$2/html/controller_8h.html"
grep -q "lh_controller_step" "$2/html/controller_8h.html"
grep -q "One decision" "$2/html/controller_8h.html"
