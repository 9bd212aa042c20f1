/* Joints that move but are no actuators - grippers, cameras, slides, wheels - are held where they are. */
#ifndef LIMPHOME_ROBOT_HOLD_H
#define LIMPHOME_ROBOT_HOLD_H

#include "elements.h"

/* Finds where each is held: at <hold home>, where <mimic> puts it, else at 0 or the limit nearest to it; a notice tells
 * of each. Needs extension_read. */
void hold_joints(struct reading *r, struct elements *e);

#endif
