/* Postures of the arm in even steps over all joints' ranges, ends included. */
#ifndef LIMPHOME_DESCRIBE_SWEEP_H
#define LIMPHOME_DESCRIBE_SWEEP_H

#include "limphome/body/robot.h"

/* Calls `visit` with `what` for each posture: angle[robot->num_actuators], 0 for crawlers. As many steps a joint as
 * make some thousand postures in all. */
void sweep(const lh_robot *robot, void (*visit)(void *what, const float *angle), void *what);

#endif
