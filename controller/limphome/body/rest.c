#include "limphome/body/rest.h"

#include <float.h>
#include <stdint.h>

#include "limphome/body/kinematics.h"
#include "limphome/body/stability.h"

#define LEAST_LEVEL 0.3f    /* of a plane to rest on: z of its normal in the body frame */
#define LEAST_SQUARE 1e-12f /* of the cross product of two sides of a triangle [m^4]; below, they are in a line */
/* For a robot of scale 1 (robot.h): */
#define BELOW_GROUND (-0.005f) /* a support this deep is taken to lie on the ground [m] */
#define NEAR_GROUND                                                                              \
    0.03f /* one no higher than this carries [m]: more than in stance.h, as joints are not quite \
             where they are told to go */

/* A plane on which the robot may rest, in the body frame. */
typedef struct plane {
    lh_vec3 point;
    lh_vec3 normal; /* unit length, upward */
} plane;

lh_quat lh_rest_upright(lh_vec3 from) {
    return lh_quat_normalise((lh_quat){1.0f + from.z, from.y, -from.x, 0.0f});
}

static float height(const plane *ground, lh_vec3 point) {
    return lh_vec3_dot(ground->normal, lh_vec3_sub(point, ground->point));
}

/* The plane through three supports of a robot of that scale; false if it is none, is steep, or another support is below
 * it. */
static bool find_plane(const lh_robot *robot, float scale, const lh_posture *posture, const int32_t corner[3],
                       plane *ground) {
    lh_vec3 a = posture->supports[corner[0]];
    lh_vec3 normal =
        lh_vec3_cross(lh_vec3_sub(posture->supports[corner[1]], a), lh_vec3_sub(posture->supports[corner[2]], a));
    float length = lh_vec3_norm(normal);
    ground->point = a;
    ground->normal = lh_vec3_scale(normal, (normal.z < 0.0f ? -1.0f : 1.0f) / length);
    if (length * length < LEAST_SQUARE || ground->normal.z < LEAST_LEVEL) {
        return false;
    }
    for (int32_t i = 0; i < robot->num_supports; i++) {
        if (height(ground, posture->supports[i]) < BELOW_GROUND * scale) {
            return false;
        }
    }
    return true;
}

/* Stands on `ground`: the margin, and whether something carries that is not part of the base. */
static lh_rest stand(const lh_robot *robot, const lh_posture *posture, const plane *ground, lh_vec3 up,
                     float tolerance) {
    lh_rest rest = {.braced = false, .normal = ground->normal};
    lh_quat turn = lh_quat_multiply(lh_rest_upright(up), lh_rest_upright(ground->normal));
    lh_vec3 carrying[LH_MAX_SUPPORTS];
    int32_t count = 0;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        if (height(ground, posture->supports[i]) <= tolerance) {
            rest.carrying[count] = i;
            carrying[count++] = lh_quat_rotate(turn, posture->supports[i]);
            if (robot->supports[i].link != 0) {
                rest.braced = true;
            }
        }
    }
    //@ split count; // for Frama-C: so many are set
    rest.num_carrying = count;
    rest.margin = lh_stability_margin(carrying, count, lh_quat_rotate(turn, posture->centre_of_mass));
    return rest;
}

void lh_rest_find(const lh_robot *robot, const float *joint_angle, lh_vec3 up, lh_rest *rest) {
    const float scale = lh_robot_scale(robot);
    lh_posture posture;
    lh_kinematics_posture(robot, (lh_quat){1.0f, 0.0f, 0.0f, 0.0f}, joint_angle, &posture);
    *rest = (lh_rest){.margin = LH_NO_REST_MARGIN, .normal = {0.0f, 0.0f, 1.0f}};
    float lowest = FLT_MAX;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        for (int32_t j = i + 1; j < robot->num_supports; j++) {
            for (int32_t k = j + 1; k < robot->num_supports; k++) {
                const int32_t corner[3] = {i, j, k};
                plane ground;
                if (!find_plane(robot, scale, &posture, corner, &ground)) {
                    continue;
                }
                float centre_height = height(&ground, posture.centre_of_mass);
                if (centre_height >= lowest) {
                    continue;
                }
                lh_rest candidate = stand(robot, &posture, &ground, up, NEAR_GROUND * scale);
                if (candidate.margin >= 0.0f) {
                    *rest = candidate;
                    lowest = centre_height;
                }
            }
        }
    }
}
