/* Sprockets of crawlers for which the file has no joint. */
#ifndef LIMPHOME_ROBOT_SPROCKET_H
#define LIMPHOME_ROBOT_SPROCKET_H

#include "elements.h"

/* Gives each a body of its own, of a mass that the base loses. Needs the masses of all others. */
void sprockets_make(struct reading *r, const struct elements *e, robot_description *robot);

#endif
