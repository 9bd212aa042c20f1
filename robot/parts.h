/* Actuators, crawlers and supports of the bodies that merging has made. */
#ifndef LIMPHOME_ROBOT_PARTS_H
#define LIMPHOME_ROBOT_PARTS_H

#include "elements.h"

/* The crawlers, in the frame of the base. */
void parts_crawlers(const struct elements *e, robot_description *robot);

void parts_actuators(const struct elements *e, robot_description *robot);

/* Tips, then what the file lists or, where it lists nothing, the ends of the belts' outer edges. */
void parts_supports(struct reading *r, const struct elements *e, robot_description *robot);

#endif
