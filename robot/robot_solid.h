/* Solids: what shapes and belts are in space, and how far two of them are apart. Both programs' checks of a robot file
 * and the simulator's contacts build on it; the controller's monitor has the same in single precision
 * (controller/limphome/safety/solid.h).
 *
 * A solid is a box, rounded by a ball or by a disc: all points at most `radius` away from the box, in any direction or
 * only across axis 2. Box: radius 0. Sphere: half sizes 0 and a ball. Cylinder: only half size 2, and a disc. Belt:
 * flat between the middles of its ends, and a disc across its sprocket. */
#ifndef LIMPHOME_ROBOT_SOLID_H
#define LIMPHOME_ROBOT_SOLID_H

#include <stdbool.h>

#include "robot_description.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct robot_solid {
    double centre[3];
    double axes[3][3]; /* the box's, of unit length, at right angles and right-handed */
    double half[3];    /* of the box along them, 0 or more */
    double radius;     /* 0 or more */
    bool disc;         /* it is rounded across axis 2 only */
} robot_solid;

/* In the frame that the shape's pose and the crawler's numbers are in. */
robot_solid robot_solid_of_shape(const robot_shape *shape);
/* The same in the frame of the base, with all joints at home. */
robot_solid robot_solid_at_home(const robot_description *robot, const robot_shape *shape);
robot_solid robot_solid_of_belt(const robot_crawler *crawler);

/* The solid seen from where its frame lies in `pose`. */
robot_solid robot_solid_placed(const robot_solid *solid, const robot_pose *pose);

/* Of a ball round the centre that holds all of the solid. */
double robot_solid_reach(const robot_solid *solid);

/* Half the width of the solid along the unit vector. */
double robot_solid_half_width(const robot_solid *solid, const double direction[3]);

/* What meets what where two solids are nearest to each other. */
typedef enum robot_meeting {
    ROBOT_FACE_OF_A, /* a face of a, whose axis is axis_a */
    ROBOT_FACE_OF_B, /* likewise */
    ROBOT_EDGES,     /* edges along axis_a and axis_b */
    ROBOT_POINTS     /* what is rounded, with anything */
} robot_meeting;

typedef struct robot_gap {
    double distance;  /* at least so far apart; below 0: moved by so much along the normal they would only just touch */
    double normal[3]; /* along which they are so far apart, from b into a */
    robot_meeting meeting;
    int axis_a, axis_b;
    double near_a[3], near_b[3]; /* ROBOT_POINTS: in or on a and b, where they are nearest to each other */
} robot_gap;

/* Exact for boxes that reach into each other, up to 0.1 mm, where a face meets a corner, an edge or a face or edges
 * cross, and for balls; otherwise the distance is too low, never too high: of boxes apart by no more than a factor of
 * sqrt(3), of the rims of discs where they touch by some thousandths of their size. */
robot_gap robot_solid_gap(const robot_solid *a, const robot_solid *b);

#ifdef __cplusplus
}
#endif
#endif
