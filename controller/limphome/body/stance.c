#include "limphome/body/stance.h"

#include <float.h>
#include <stdbool.h>

/* For a robot of scale 1 (robot.h): */
#define NEAR_GROUND 0.005f /* a support no higher than this above the ground carries [m] */
#define LEAST_AREA 1e-6f   /* twice that of a triangle seen from above [m^2] */

static const lh_vec3 vertical = {0.0f, 0.0f, 1.0f};

/* Twice the area of the triangle p, a, b seen from above; positive if it is to the left of a->b. */
static float area(lh_vec3 p, lh_vec3 a, lh_vec3 b) {
    return (a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x);
}

/* Height of the triangle under or over p; FLT_MAX where it is not there or smaller than `least`. */
static float height_at(lh_vec3 p, const lh_vec3 corner[3], float least) {
    float a = area(p, corner[1], corner[2]);
    float b = area(p, corner[2], corner[0]);
    float c = area(p, corner[0], corner[1]);
    float whole = a + b + c;
    float turn = whole < 0.0f ? -1.0f : 1.0f;
    if (turn * a < 0.0f || turn * b < 0.0f || turn * c < 0.0f || turn * whole < least) {
        return FLT_MAX;
    }
    return (a * corner[0].z + b * corner[1].z + c * corner[2].z) / whole;
}

/* Indices of the three supports between which the ground is, into corner[]; false if there are none. */
static bool find_corners(const lh_robot *robot, const lh_posture *posture, float least, int32_t corner[3]) {
    const lh_vec3 *support = posture->supports;
    float lowest = FLT_MAX;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        for (int32_t j = i + 1; j < robot->num_supports; j++) {
            for (int32_t k = j + 1; k < robot->num_supports; k++) {
                const lh_vec3 corners[3] = {support[i], support[j], support[k]};
                float height = height_at(posture->centre_of_mass, corners, least);
                if (height < lowest) {
                    lowest = height;
                    corner[0] = i;
                    corner[1] = j;
                    corner[2] = k;
                }
            }
        }
    }
    return lowest < FLT_MAX;
}

/* Where support i touches ground of that normal: a ball rolls on it. */
static lh_vec3 touching(const lh_robot *robot, const lh_posture *posture, int32_t i, lh_vec3 normal) {
    float radius = robot->supports[i].radius;
    lh_vec3 point = posture->supports[i];
    if (radius > 0.0f) {
        point = lh_vec3_add(point, lh_vec3_scale(lh_vec3_sub(vertical, normal), radius));
    }
    return point;
}

/* Of the ground under the corners. A ball moves where it touches by the normal that it is to give, so once more with
 * that. */
static lh_vec3 find_normal(const lh_robot *robot, const lh_posture *posture, const int32_t corner[3]) {
    lh_vec3 normal = vertical;
    for (int32_t pass = 0; pass < 2; pass++) {
        lh_vec3 point[3];
        for (int32_t i = 0; i < 3; i++) {
            point[i] = touching(robot, posture, corner[i], normal);
        }
        lh_vec3 across = lh_vec3_cross(lh_vec3_sub(point[1], point[0]), lh_vec3_sub(point[2], point[0]));
        normal = lh_vec3_scale(across, (across.z < 0.0f ? -1.0f : 1.0f) / lh_vec3_norm(across));
    }
    return normal;
}

void lh_stance_find(const lh_robot *robot, const lh_posture *posture, lh_stance *stance) {
    const float scale = lh_robot_scale(robot);
    int32_t corner[3] = {0, 0, 0};
    lh_vec3 normal = vertical;
    if (find_corners(robot, posture, LEAST_AREA * scale * scale, corner)) {
        normal = find_normal(robot, posture, corner);
    } else {
        for (int32_t i = 1; i < robot->num_supports; i++) {
            corner[0] = posture->supports[i].z < posture->supports[corner[0]].z ? i : corner[0];
        }
    }
    lh_vec3 ground = touching(robot, posture, corner[0], normal);
    *stance = (lh_stance){.count = 0};
    for (int32_t i = 0; i < robot->num_supports; i++) {
        lh_vec3 point = touching(robot, posture, i, normal);
        if (lh_vec3_dot(normal, lh_vec3_sub(point, ground)) <= NEAR_GROUND * scale) {
            stance->carrying[stance->count] = i;
            stance->points[stance->count++] = point;
        }
    }
}
