#include "limphome/body/quasi_static.h"

#include <stdbool.h>
#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/base/lanes.h"
#include "limphome/body/kinematics.h"

/* Friction that grows with the slip at first lets Newton's method find the way; then it is made steeper and steeper. */
#define ITERATIONS 5
#define SOFTNESS 2.0f    /* slip at which friction bends at first, in longest travels */
#define HARDENING 0.4f   /* of that, from one iteration to the next */
#define LEVEL 0.9995f    /* of the vertical along the ground's normal: a slope below 1.8 degrees is taken to be level */
#define SMALL_TURN 0.02f /* of a joint, to see how far the tip goes [rad] */
#define SMALL 1e-6f      /* keeps the equations solvable where all supports lie in a point or a line */

/* Shares of the weight that hold the centre of mass, the least ones by their squares: a plane over the supports. */
static void share_load(lh_footing *footing, lh_vec3 centre) {
    float each = 1.0f / (float)footing->count;
    float middle_x = 0.0f;
    float middle_y = 0.0f;
    for (int32_t i = 0; i < footing->count; i++) {
        middle_x += each * footing->x[i];
        middle_y += each * footing->y[i];
    }
    float xx = SMALL;
    float xy = 0.0f;
    float yy = SMALL;
    for (int32_t i = 0; i < footing->count; i++) {
        float dx = footing->x[i] - middle_x;
        float dy = footing->y[i] - middle_y;
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    float determinant = xx * yy - xy * xy;
    float slope_x = ((centre.x - middle_x) * yy - (centre.y - middle_y) * xy) / determinant;
    float slope_y = ((centre.y - middle_y) * xx - (centre.x - middle_x) * xy) / determinant;
    float sum = SMALL;
    for (int32_t i = 0; i < footing->count; i++) {
        float load = each + slope_x * (footing->x[i] - middle_x) + slope_y * (footing->y[i] - middle_y);
        footing->load[i] = load > 0.0f ? load : 0.0f;
        sum += footing->load[i];
    }
    for (int32_t i = 0; i < footing->count; i++) {
        footing->load[i] /= sum;
    }
}

/* How the joint moves the supports that hang on it, by kinematics a small turn away. */
static void find_shift_by_joint(const lh_robot *robot, lh_quat attitude, const float *joint_angle, const lh_rest *rest,
                                int32_t joint, float travel, lh_footing *footing) {
    float angle[LH_MAX_ACTUATORS];
    memcpy(angle, joint_angle, sizeof(float) * (size_t)robot->num_actuators);
    angle[joint] += SMALL_TURN;
    lh_posture posture;
    lh_kinematics_posture(robot, attitude, angle, &posture);
    for (int32_t i = 0; i < footing->count; i++) {
        lh_vec3 point = posture.supports[rest->carrying[i]];
        footing->shift_x[joint][i] = (point.x - footing->x[i]) * (travel / SMALL_TURN);
        footing->shift_y[joint][i] = (point.y - footing->y[i]) * (travel / SMALL_TURN);
    }
}

/* The belt runs backwards below while it drives forward. */
static void find_shift_by_crawler(const lh_robot *robot, const lh_rest *rest, int32_t crawler, float travel,
                                  lh_footing *footing) {
    for (int32_t i = 0; i < footing->count; i++) {
        bool is_left = footing->y[i] > 0.0f;
        bool is_its = robot->supports[rest->carrying[i]].link == 0 && is_left == (crawler == 0);
        footing->shift_x[crawler][i] = is_its ? -travel : 0.0f;
    }
}

void lh_footing_find(const lh_robot *robot, const float *joint_angle, const lh_rest *rest, lh_vec3 up,
                     const float *travel, float friction, lh_footing *footing) {
    memset(footing, 0, sizeof *footing);
    footing->count = rest->num_carrying;
    lh_quat attitude = lh_rest_upright(rest->normal);
    lh_posture posture;
    lh_kinematics_posture(robot, attitude, joint_angle, &posture);
    for (int32_t i = 0; i < footing->count; i++) {
        lh_vec3 point = posture.supports[rest->carrying[i]];
        footing->x[i] = point.x;
        footing->y[i] = point.y;
    }
    if (footing->count > 0) {
        share_load(footing, posture.centre_of_mass);
    }
    for (int32_t k = 0; k < robot->num_actuators; k++) {
        if (robot->actuators[k].kind == LH_CRAWLER) {
            find_shift_by_crawler(robot, rest, k, travel[k], footing);
        } else if (rest->braced) {
            find_shift_by_joint(robot, attitude, joint_angle, rest, k, travel[k], footing);
        }
        footing->travel = travel[k] > footing->travel ? travel[k] : footing->travel;
    }
    footing->level = up.z > LEVEL;
    footing->pull_x = footing->level ? 0.0f : -up.x / (up.z * friction);
    footing->pull_y = footing->level ? 0.0f : -up.y / (up.z * friction);
}

/* Motions are found side by side; one after the other where there are no vectors. */
#if LH_VECTOR_WIDTH > 1
#define WIDTH LH_MOTIONS
typedef float lanes __attribute__((vector_size(4 * WIDTH)));
#else
#define WIDTH 1
typedef float lanes;
#endif

typedef struct twists {
    lanes forward, sideways, turn;
} twists;

/* x in every lane; its sign, too, where it is 0. */
static inline lanes everywhere(float x) {
    const lanes zero = {0.0f};
    return x - zero;
}

static inline lanes square_roots(lanes x) {
    float each[WIDTH];
    memcpy(each, &x, sizeof each);
    for (int32_t m = 0; m < WIDTH; m++) {
        each[m] = __builtin_sqrtf(each[m]);
    }
    memcpy(&x, each, sizeof each);
    return x;
}

/* What brings a reach down to `most`, where it is more. */
static inline lanes shortened(lanes reach, float most) {
    float each[WIDTH];
    memcpy(each, &reach, sizeof each);
    for (int32_t m = 0; m < WIDTH; m++) {
        each[m] = each[m] > most ? most / each[m] : 1.0f;
    }
    memcpy(&reach, each, sizeof each);
    return reach;
}

/* One step of Newton's method towards the least sum of load * sqrt(|slip|^2 + softness^2). */
static void improve(const lh_footing *footing, const lanes *shift_x, const lanes *shift_y, float softness,
                    twists *twist) {
    /* gradient, and the upper half of the symmetric Hessian, in the order forward, sideways, turn */
    lanes g0 = everywhere(-footing->pull_x);
    lanes g1 = everywhere(-footing->pull_y);
    lanes g2 = everywhere(0.0f);
    lanes h00 = everywhere(SMALL);
    lanes h01 = everywhere(0.0f);
    lanes h02 = h01;
    lanes h11 = h00;
    lanes h12 = h01;
    lanes h22 = h00;
    for (int32_t i = 0; i < footing->count; i++) {
        float x = footing->x[i];
        float y = footing->y[i];
        lanes slip_x = twist->forward - twist->turn * y + shift_x[i];
        lanes slip_y = twist->sideways + twist->turn * x + shift_y[i];
        lanes inverse = 1.0f / square_roots(slip_x * slip_x + slip_y * slip_y + softness * softness);
        lanes weight = footing->load[i] * inverse;
        lanes force_x = weight * slip_x;
        lanes force_y = weight * slip_y;
        lanes bend = weight * inverse * inverse;
        lanes xx = weight - bend * slip_x * slip_x;
        lanes xy = -bend * slip_x * slip_y;
        lanes yy = weight - bend * slip_y * slip_y;
        g0 += force_x;
        g1 += force_y;
        g2 += x * force_y - y * force_x;
        h00 += xx;
        h01 += xy;
        h11 += yy;
        h02 += x * xy - y * xx;
        h12 += x * yy - y * xy;
        h22 += x * (x * yy - y * xy) - y * (x * xy - y * xx);
    }
    /* by elimination; the Hessian is positive definite */
    lanes l1 = h01 / h00;
    lanes l2 = h02 / h00;
    lanes d1 = h11 - l1 * h01;
    lanes d12 = h12 - l1 * h02;
    lanes l12 = d12 / d1;
    lanes d2 = h22 - l2 * h02 - l12 * d12;
    lanes r1 = g1 - l1 * g0;
    lanes turn = (g2 - l2 * g0 - l12 * r1) / d2;
    lanes sideways = (r1 - d12 * turn) / d1;
    lanes forward = (g0 - h01 * sideways - h02 * turn) / h00;
    lanes reach = square_roots(forward * forward + sideways * sideways + turn * turn);
    lanes scale = shortened(reach, footing->travel);
    twist->forward -= scale * forward;
    twist->sideways -= scale * sideways;
    twist->turn -= scale * turn;
}

/* WIDTH motions; those beyond `count` are the first. */
static twists find_side_by_side(const lh_footing *footing, int32_t num_actuators, int32_t count,
                                const lh_shares *share) {
    lanes shift_x[LH_MAX_SUPPORTS];
    lanes shift_y[LH_MAX_SUPPORTS];
    memset(shift_x, 0, sizeof shift_x);
    memset(shift_y, 0, sizeof shift_y);
    for (int32_t k = 0; k < num_actuators; k++) {
        float each[WIDTH];
        bool moves = false;
        for (int32_t m = 0; m < WIDTH; m++) {
            each[m] = share[m < count ? m : 0].of[k];
            moves = moves || each[m] != 0.0f;
        }
        lanes shares;
        memcpy(&shares, each, sizeof shares);
        for (int32_t i = 0; moves && i < footing->count; i++) {
            shift_x[i] += shares * footing->shift_x[k][i];
            shift_y[i] += shares * footing->shift_y[k][i];
        }
    }
    twists twist = {everywhere(0.0f), everywhere(0.0f), everywhere(0.0f)};
    float softness = SOFTNESS * footing->travel;
    for (int32_t i = 0; footing->count > 0 && i < ITERATIONS; i++) {
        improve(footing, shift_x, shift_y, softness, &twist);
        softness *= HARDENING;
    }
    return twist;
}

void lh_quasi_static_motions(const lh_footing *footing, int32_t num_actuators, int32_t count, const lh_shares *share,
                             lh_twist *twist) {
    for (int32_t first = 0; first < count; first += WIDTH) {
        twists found = find_side_by_side(footing, num_actuators, count - first, &share[first]);
        float part[3][WIDTH];
        memcpy(part, &found, sizeof part);
        for (int32_t m = 0; m < WIDTH && first + m < count; m++) {
            twist[first + m] = (lh_twist){part[0][m], part[1][m], part[2][m]};
        }
    }
}

lh_twist lh_quasi_static_motion(const lh_footing *footing, int32_t num_actuators, const float *share) {
    lh_shares shares;
    memcpy(shares.of, share, sizeof(float) * (size_t)num_actuators);
    lh_twist twist;
    lh_quasi_static_motions(footing, num_actuators, 1, &shares, &twist);
    return twist;
}
