/* Where the robot stands: the body frame follows from the crawlers, wherever the file has its own. */
#ifndef LIMPHOME_ROBOT_STANCE_H
#define LIMPHOME_ROBOT_STANCE_H

#include "elements.h"

/* Pose of the root link in the body frame, from crawlers in the frame of the root link; sprockets are made to turn
 * forward. False, with faults, if the crawlers are no pair. */
bool stance_find(struct reading *r, struct elements *e, const robot_description *robot, frame *root_pose);

#endif
