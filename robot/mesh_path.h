/* Where the mesh lies that a robot file names. */
#ifndef LIMPHOME_ROBOT_MESH_PATH_H
#define LIMPHOME_ROBOT_MESH_PATH_H

#include "reading.h"

/* Where a copy of the mesh is looked for first, seen from the robot file's folder: so a robot file can be kept with its
 * meshes. Below robot_meshes/, named as in the robot file, with _ and two hexadecimal digits, _2f for /, in place of
 * whatever is no letter, digit, dot or minus. */
const char *mesh_copy(struct reading *r, const char *name);

/* Path of the file that `name` stands for, or NULL if there is none: package:// and model:// names are looked for in
 * the folders of r->packages, then in those above the robot file; file:// and plain names from the robot file's folder
 * or, where there is none, by their ends as if these were names in packages, so that paths of another machine are
 * found. */
char *mesh_path(struct reading *r, const char *name);

#endif
