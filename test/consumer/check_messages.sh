#!/bin/sh
# check_messages.sh BUILD PREFIX: installs the message types; a driver in C and one in C++ are compiled with them.
set -eu
rm -rf "$2"
cmake --install "$1" --prefix "$2" --component messages
test -f "$2/share/limphome/lcmtypes/limphome_robot_state.lcm"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/driver.c" <<'END'
#include <limphome_robot_state_t.h>
#include <stdio.h>
int main(void) {
    limphome_robot_state_t state = {.num_actuators = 5};
    printf("%d bytes\n", limphome_robot_state_t_encoded_size(&state));
    return 0;
}
END
cat >"$work/driver.cpp" <<'END'
#include <cstdio>
#include <limphome/robot_state_t.hpp>
int main() {
    limphome::robot_state_t state{};
    std::printf("%d bytes\n", state.getEncodedSize());
}
END
library=$(dirname "$(find "$2" -name 'liblimphome_lcmtypes.a')")
# shellcheck disable=SC2046,SC2086 # several words
${CC:-cc} ${CFLAGS-} "$work/driver.c" -I"$2/include/lcmtypes" $(pkg-config --cflags lcm) -L"$library" \
    -llimphome_lcmtypes $(pkg-config --libs lcm) -o "$work/c"
# shellcheck disable=SC2046,SC2086
${CXX:-c++} ${CXXFLAGS-} "$work/driver.cpp" -I"$2/include/lcmtypes" $(pkg-config --cflags --libs lcm) -o "$work/cpp"
test "$("$work/c")" = "$("$work/cpp")"
"$work/c"
