/* Solids: parts of the robot that must not run into each other, and how far two of them are apart.
 *
 * A solid is a box, rounded by a ball or by a disc: all points at most `radius` away from the box, in any direction or
 * only across its z axis. Box: radius 0. Sphere: half sizes 0 and a ball. Cylinder: only half size z, and a disc. Belt:
 * flat between the middles of its ends, and a disc across its sprocket, which is z. */
#ifndef LIMPHOME_SOLID_H
#define LIMPHOME_SOLID_H

#include <stdbool.h>

#include "limphome/base/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_solid {
    lh_vec3 centre;
    lh_vec3 x, y, z; /* axes of the box, unit length, at right angles */
    lh_vec3 half;    /* sizes of the box along them, 0 or more [m] */
    float radius;    /* 0 or more [m] */
    bool disc;       /* it is rounded across z only */
} lh_solid;

/* At least so far apart [m]; below 0: they reach into each other, and have to be moved by so much to only just touch.
 * What is `enough` or more is not looked at more closely. Exact up to rounding for boxes that reach into each other,
 * where a face meets anything or edges cross, and for balls; otherwise too low, never too high. */
float lh_solid_distance(const lh_solid *a, const lh_solid *b, float enough);

#ifdef __cplusplus
}
#endif
#endif
