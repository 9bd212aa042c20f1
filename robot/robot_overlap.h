/* Which of the robot's bodies stand inside each other in its initial pose, where nothing keeps them from it. */
#ifndef LIMPHOME_ROBOT_OVERLAP_H
#define LIMPHOME_ROBOT_OVERLAP_H

#include "robot_description.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Two shapes of bodies that may meet. */
typedef struct robot_overlap {
    int shape, other; /* indices into robot->shapes; robot->num_shapes + 0, 1: the left, the right belt */
    double depth;     /* above 0: by so much they must be parted to only just touch [m] */
} robot_overlap;

/* Fills in the first `most` overlaps with all joints at home, ordered by shape and then by the other, and returns how
 * many there are. */
int robot_overlaps_at_home(const robot_description *robot, robot_overlap *overlaps, int most);

#ifdef __cplusplus
}
#endif
#endif
