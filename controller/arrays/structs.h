/* The library's structs as initialisers. */
#ifndef LIMPHOME_ARRAYS_STRUCTS_H
#define LIMPHOME_ARRAYS_STRUCTS_H

#include "initialiser.h"
#include "limphome/controller.h"

/* Each writes a definition of that name. */
void structs_robot(initialiser *i, const char *name, const lh_robot *robot);
void structs_shapes(initialiser *i, const char *name, const lh_shapes *shapes, int32_t num_links);
void structs_controlled(initialiser *i, const char *name, const lh_controlled *controlled);
void structs_config(initialiser *i, const char *name, const lh_config *config);
void structs_learned(initialiser *i, const char *name, const lh_learned *learned);

#endif
