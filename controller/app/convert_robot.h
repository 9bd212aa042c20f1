/* The robot as the library wants it, of what its file says. */
#ifndef LIMPHOME_APP_CONVERT_ROBOT_H
#define LIMPHOME_APP_CONVERT_ROBOT_H

#include <stdbool.h>

#include "fail.h"
#include "limphome/body/robot.h"
#include "limphome/safety/collision.h"
#include "robot_description.h"

/* A link per body. False, nothing changed, with the reason in `error`, if the library was built too small for it. */
bool convert_robot(const robot_description *from, lh_robot *robot, char error[ERROR_LENGTH]);

/* What the monitor is to keep apart: belts, shapes of the arm, shapes of the base, of each those that may meet
 * anything. Returns how many there is no room for, which are the last. */
int convert_shapes(const robot_description *from, lh_shapes *shapes);

#endif
