/* Meshes as shapes: the box round their vertices. */
#ifndef LIMPHOME_ROBOT_MESH_H
#define LIMPHOME_ROBOT_MESH_H

#include "elements.h"

/* Makes `shape` the box round the mesh of a <mesh> element, which a notice tells. False, with a fault, if the mesh
 * cannot be found or read. */
bool mesh_read(struct reading *r, const struct xml_element *at, struct file_shape *shape);

#endif
