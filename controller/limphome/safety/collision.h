/* Collisions: whether a motion of the joints brings parts of the robot together that must not meet. */
#ifndef LIMPHOME_COLLISION_H
#define LIMPHOME_COLLISION_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A part of a link, or a belt, which is part of link 0: a solid (solid.h) in the link's frame. */
typedef struct lh_shape {
    lh_vec3 centre;   /* [m] */
    lh_quat rotation; /* of its axes, unit length */
    lh_vec3 half;     /* half the sizes of its box, 0 or more [m] */
    float radius;     /* it is rounded with, 0 or more [m] */
    int16_t link;
    bool disc; /* rounded across its z axis only */
} lh_shape;

typedef struct lh_shapes {
    int32_t count;                   /* 0 to LH_MAX_SHAPES; 0: nothing is known, and no collision found */
    uint32_t may_meet[LH_MAX_LINKS]; /* bit j: link j is to be kept clear of. Not of itself; nothing of sprockets */
    lh_shape shape[LH_MAX_SHAPES];   /* [count] */
} lh_shapes;

/* A motion is looked at wherever the joints have turned by this much more, summed over them [rad]; the arm of a robot
 * of 2 m goes 10 cm in between, which is less than it is thick or than what it may hit ... */
#define LH_SWEEP_STEP 0.05f
/* ... but at no more places than these, for one that is longer than any decision. */
#define LH_SWEEP_MOST 40

/* LH_OK, or LH_ERROR_ROBOT where a rule above is broken, a magnitude is above its limit (robot.h), or a link is not one
 * of the robot's, which must be valid itself. */
lh_error lh_shapes_validate(const lh_shapes *shapes, const lh_robot *robot);

/* Bit k: actuator k takes part in a motion from angle[robot->num_actuators] to next[robot->num_actuators] [rad] that
 * brings two links nearer to each other than `clearance` [m], and nearer than they are. 0: none does. Without those
 * that are told, other links may come together: ask again. */
uint32_t lh_collision_joints(const lh_robot *robot, const lh_shapes *shapes, float clearance, const float *angle,
                             const float *next);

#ifdef __cplusplus
}
#endif
#endif
