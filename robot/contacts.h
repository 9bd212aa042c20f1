/* Which bodies may touch each other. */
#ifndef LIMPHOME_ROBOT_CONTACTS_H
#define LIMPHOME_ROBOT_CONTACTS_H

#include "elements.h"

/* Those that are not joined, less what <no_contact> and self_contact="false" except. */
void contacts_find(struct reading *r, const struct elements *e, robot_description *robot);

/* Bodies that stand inside each other in the initial pose would burst apart: a fault, or, where a mesh is only
 * approximated, an exception with a remark. Needs shapes. */
void contacts_check(struct reading *r, const struct elements *e, robot_description *robot);

#endif
