/* Links that do not move against each other become one body each: there is one for the base and one per actuator. */
#ifndef LIMPHOME_ROBOT_MERGE_H
#define LIMPHOME_ROBOT_MERGE_H

#include "elements.h"

/* Finds body and pose of every link, the root link's being `root_pose` in the body frame. False, with faults, if
 * actuators do not fit the tree. `order` as of tree_resolve. */
bool merge_links(struct reading *r, struct elements *e, const int order[MOST_LINKS], const frame *root_pose,
                 robot_description *robot);

/* Mass, centre and inertia of the bodies. */
void merge_masses(struct reading *r, struct elements *e, const int order[MOST_LINKS], robot_description *robot);

#endif
