/* What the robot stands on in the attitude that it has. The ground is taken to be even, of whatever slope: a robot at
 * rest on it stands on a face of the convex hull of its supports, and the vertical through its centre of mass leads
 * through that face. */
#ifndef LIMPHOME_STANCE_H
#define LIMPHOME_STANCE_H

#include <stdint.h>

#include "limphome/body/kinematics.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_stance {
    int32_t count;                     /* of the points */
    int32_t carrying[LH_MAX_SUPPORTS]; /* [count] supports that carry, ascending */
    lh_vec3 points[LH_MAX_SUPPORTS];   /* [count] where they touch the ground, in the frame of the posture [m] */
} lh_stance;

/* Of all triangles of supports that lie, seen from above, under the centre of mass, the one that is lowest there gives
 * the plane of the ground. What is hardly above it carries, too: within 5 mm for a robot of the paper's size, which the
 * ground gives way by. Where there is no triangle the robot is about to tip over, and what is lowest carries. */
void lh_stance_find(const lh_robot *robot, const lh_posture *posture, lh_stance *stance);

#ifdef __cplusplus
}
#endif
#endif
