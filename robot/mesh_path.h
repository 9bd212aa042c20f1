/* Where the mesh lies that a robot file names. */
#ifndef LIMPHOME_ROBOT_MESH_PATH_H
#define LIMPHOME_ROBOT_MESH_PATH_H

#include "reading.h"

/* Folder beside a robot file that is looked into first: copies of its meshes, each named as in the robot file but with
 * _ for every character that is not a letter, a digit, a dot or a minus. So a robot file can be kept with its meshes.
 */
#define MESH_COPIES "robot_meshes"

/* Path of the file that `name` stands for, or NULL if there is none: package:// and model:// names are looked for in
 * the folders of r->packages, then in those above the robot file; file:// and plain names from the robot file's folder.
 */
const char *mesh_path(struct reading *r, const char *name);

#endif
