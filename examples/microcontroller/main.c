/* Drives by a learned policy: policy.h and robot.h are what `scripts/export RUN --format c` has written. */
#include "board.h"
#include "policy.h"
#include "robot.h"

int main(void) {
    static lh_controller controller; /* all the memory there is */
    if (lh_controller_init(&controller, &limphome_config, &limphome_robot, &limphome_controlled) != LH_OK ||
        lh_controller_keep_apart(&controller, &limphome_shapes) != LH_OK ||
        lh_controller_restore(&controller, &limphome_learned, limphome_episode) != LH_OK) {
        return 1; /* the library was built with too small capacities */
    }
    lh_state state;
    while (board_sense(&state)) {
        lh_decision decision;
        lh_controller_step(&controller, &state, &decision); /* holds still where the state is not valid */
        board_drive(decision.velocity);
        if (decision.observed.reset) { /* stands still now, and goes on from where it is */
            lh_controller_resume(&controller, controller.task.episode.number);
        }
    }
    return 0;
}
