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
} lh_posture;

/* `attitude` is body to world; joint_angle[robot->num_actuators] holds the joints' angles [rad] and is not read for
 * crawlers. */
void lh_kinematics_posture(const lh_robot *robot, lh_quat attitude, const float *joint_angle, lh_posture *posture);

#ifdef __cplusplus
}
#endif
#endif
