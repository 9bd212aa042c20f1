/* Kinematics: where the centre of mass and the support points are, from attitude and joint angles alone. */
#ifndef LIMPHOME_KINEMATICS_H
#define LIMPHOME_KINEMATICS_H

#include <stdint.h>

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All in a frame with the body's origin and the world's axes [m]. */
typedef struct lh_posture {
    lh_vec3 centre_of_mass;
    lh_vec3 supports[LH_MAX_SUPPORTS]; /* [robot->num_supports], lowest point of each support */
    int32_t num_carrying;              /* entries used in carrying */
    int32_t carrying[LH_MAX_SUPPORTS]; /* indices of the supports that can carry the robot on level ground, ascending */
} lh_posture;

/* Range of the tolerance by which supports count as carrying. */
#define LH_SUPPORT_TOLERANCE_MIN 0.001f /* [m] */
#define LH_SUPPORT_TOLERANCE_MAX 1.0f   /* [m] */

/* `attitude` is body to world; joint_angle[robot->num_actuators] holds the joints' angles [rad] and is not read for
 * crawlers.
 * Carrying: on level ground the robot stands on its lowest support points. Those within `tolerance` [m] of the plane
 * that the attitude gives, the level plane through the lowest support, are taken to carry it. */
void lh_kinematics_posture(const lh_robot *robot, lh_quat attitude, const float *joint_angle, float tolerance,
                           lh_posture *posture);

#ifdef __cplusplus
}
#endif
#endif
