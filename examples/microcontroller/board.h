/* What the example needs of a board: three functions that you write for yours. emulated.c has them for the boards that
 * QEMU emulates. */
#ifndef BOARD_H
#define BOARD_H

#include <limphome/controller.h>

/* Waits for the next decision period and reads the sensors; false: there is no more to do. Where nothing tells the
 * robot's position, leave it 0 (docs/real_robot.md). */
bool board_sense(lh_state *state);

/* Wanted rates of all actuators until the next call: m/s of a crawler's belt, rad/s of a joint. */
void board_drive(const float velocity[LH_MAX_ACTUATORS]);

#endif
