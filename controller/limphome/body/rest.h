/* How the robot would come to rest on even ground in a posture of its arm: on which of its supports, how the body then
 * lies, and how stable it is. From the known kinematics alone, nothing is measured. */
#ifndef LIMPHOME_REST_H
#define LIMPHOME_REST_H

#include <stdbool.h>

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_NO_REST_MARGIN (-1.0f) /* margin where the robot does not come to rest [m] */

typedef struct lh_rest {
    int32_t num_carrying;
    int32_t carrying[LH_MAX_SUPPORTS]; /* [num_carrying] supports it stands on, ascending */
    bool braced;    /* stands on something that is not part of its base, such as the tip of the arm */
    float margin;   /* S_NE of (11) there, LH_NO_REST_MARGIN if it rests nowhere [m] */
    lh_vec3 normal; /* of the ground, in the body frame, unit length; z if it rests nowhere */
} lh_rest;

/* The rotation by the shortest way that takes the unit vector `from`, whose z is above -1, to the z axis. */
lh_quat lh_rest_upright(lh_vec3 from);

/* Of all triples of supports that can carry the robot, those below which no other support reaches and over which its
 * centre of mass lies, the one that brings the centre of mass lowest.
 * joint_angle[robot->num_actuators] as for lh_kinematics_posture; `up` is the vertical, unit length, in the frame of
 * the ground: z its normal, x along the robot's heading; (0, 0, 1) where it is level. Supports within
 * 3 cm of the ground carry, too, times lh_robot_scale(). */
void lh_rest_find(const lh_robot *robot, const float *joint_angle, lh_vec3 up, lh_rest *rest);

#ifdef __cplusplus
}
#endif
#endif
