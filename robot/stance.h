/* Where the robot stands: the body frame follows from the crawlers, wherever the file has its own. */
#ifndef LIMPHOME_ROBOT_STANCE_H
#define LIMPHOME_ROBOT_STANCE_H

#include "elements.h"

/* Expresses all of `robot` in the body frame. False, with faults, if the crawlers are no pair. */
bool stance_find(struct reading *r, const struct elements *e, robot_description *robot);

/* What the robot stands on besides its tips, where the file lists nothing: the ends of the belts' outer edges. */
void stance_add_supports(robot_description *robot);

#endif
