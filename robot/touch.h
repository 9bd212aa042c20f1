/* Shapes with which the robot touches the ground and itself. */
#ifndef LIMPHOME_ROBOT_TOUCH_H
#define LIMPHOME_ROBOT_TOUCH_H

#include "elements.h"

/* The tips' balls and the shapes of all links, less those that are the belt itself: tracks and wheels drawn as shapes,
 * which would rub or jam. Faults where the robot would not stand on its crawlers, or a shape would turn with a
 * sprocket. Needs bodies, crawlers and supports in the body frame. */
void touch_find(struct reading *r, struct elements *e, const int order[MOST_LINKS], robot_description *robot);

#endif
