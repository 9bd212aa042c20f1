/* Whether bodies have the mass and inertia that a body can have. */
#ifndef LIMPHOME_ROBOT_INERTIA_H
#define LIMPHOME_ROBOT_INERTIA_H

#include "elements.h"

/* Faults where none has; notices where a link has not but makes no difference to the body it is part of, as the
 * placeholders that tools leave in small parts. Sprockets may
 * have any: theirs is that of a drive train, seen through its gear. */
void inertia_check(struct reading *r, const struct elements *e, const robot_description *robot);

#endif
