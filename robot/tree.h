/* Links and joints as a tree: every joint between two links that are there, every link but one, the root, on one joint.
 */
#ifndef LIMPHOME_ROBOT_TREE_H
#define LIMPHOME_ROBOT_TREE_H

#include "elements.h"

/* Resolves the names, and gives the links in `order` such that each follows the one it hangs on. False, with faults, if
 * they are no tree. */
bool tree_resolve(struct reading *r, struct elements *e, int order[MOST_LINKS]);

#endif
