/* The board's functions where there is no robot: states of states.bin, one after the other, and velocities to
 * velocities.bin. Both are of floats: a state is position, orientation, then position, effort and failed (0 or 1) of
 * each actuator; a velocity is one of each actuator. */
#include <string.h>

#include "board.h"
#include "platform.h"

enum { ACTUATORS = 5, POSE = 7 };
_Static_assert(ACTUATORS <= LH_MAX_ACTUATORS, "the robot's");

bool board_sense(lh_state *state) {
    static int file = -1;
    float told[POSE + 3 * ACTUATORS];
    file = file < 0 ? platform_open("states.bin", false) : file;
    if (file < 0 || !platform_read(file, told, sizeof told)) {
        return false;
    }
    memset(state, 0, sizeof *state);
    memcpy(state->position, told, sizeof state->position);
    state->orientation = (lh_quat){told[3], told[4], told[5], told[6]};
    state->num_actuators = ACTUATORS;
    for (int a = 0; a < ACTUATORS; a++) {
        const float *of = told + POSE + a;
        state->actuator_position[a] = of[0];
        state->actuator_effort[a] = of[ACTUATORS];
        state->actuator_failed[a] = of[2 * ACTUATORS] != 0;
    }
    return true;
}

void board_drive(const float velocity[LH_MAX_ACTUATORS]) {
    static int file = -1;
    file = file < 0 ? platform_open("velocities.bin", true) : file;
    platform_write(file, velocity, ACTUATORS * sizeof *velocity);
}
