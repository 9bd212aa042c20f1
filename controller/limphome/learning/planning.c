#include "limphome/learning/planning.h"

#include <float.h>
#include <stdbool.h>
#include <string.h>

#include "limphome/base/elementary.h"

#define FRICTION 0.7f      /* guess, of use on slopes: rubber on concrete */
#define SAFE_MARGIN 0.02f  /* S_safe [m], times lh_robot_scale() */
#define LACKING_MAX 3.0f   /* of 1 - S / S_safe */
#define STEERING_BEND 0.1f /* the penalty is quadratic up to here, linear beyond [rad] */
#define KNOWN 0.1f         /* weight of samples at which half of the doubt is gone */
#define JAMMED 0.6f        /* an arm that moves less than this share is taken not to get anywhere */

float lh_course_steering(lh_course course) {
    return course.heading + LH_STEERING_GAIN * course.lateral;
}

/* Penalty for a steering error. */
static float steering_cost(const lh_planner *planner, float error) {
    float size = lh_magnitude(error);
    float bent = size < STEERING_BEND ? size * size / STEERING_BEND : 2.0f * size - STEERING_BEND;
    return planner->config.steering * bent;
}

/* Cost of standing for a decision in a posture with this margin [m]. */
static float standing_cost(const lh_planner *planner, float margin) {
    float safe = SAFE_MARGIN * lh_robot_scale(&planner->robot);
    float lacking = lh_clip(1.0f - margin / safe, 0.0f, LACKING_MAX);
    return planner->task.reward.stability * lh_exp(-margin) + planner->config.unsafe * lacking;
}

/* How the robot rests with its planned joints at `angle`; joint_angle[] becomes the angles of all. */
static void find_rest(const lh_planner *planner, const float *angle, float *joint_angle, lh_rest *rest) {
    memcpy(joint_angle, planner->joint_angle, sizeof planner->joint_angle);
    lh_planned_set_angles(&planner->planned, angle, joint_angle);
    lh_rest_find(&planner->robot, joint_angle, planner->up, rest);
}

void lh_planning_assess(lh_planner *planner) {
    lh_posture_values *values = &planner->learned.values;
    for (int32_t node = 0; node < values->num_nodes; node++) {
        float angle[LH_PLANNED_JOINTS];
        float joint_angle[LH_MAX_ACTUATORS];
        lh_rest rest;
        lh_posture_angles(values, node, angle);
        find_rest(planner, angle, joint_angle, &rest);
        lh_posture_set_cost(values, node, standing_cost(planner, rest.margin));
    }
}

/* What mechanics says of `count` actions from `first` on. */
static void expect_some(const lh_planner *planner, int32_t first, int32_t count, lh_outlook *outlook) {
    const lh_planned *planned = &planner->planned;
    lh_shares share[LH_MOTIONS];
    memset(share, 0, sizeof share);
    for (int32_t m = 0; m < count; m++) {
        for (int32_t k = 0; k < planned->count; k++) {
            share[m].of[planned->actuator[k]] = (float)(planned->level[first + m][k] - 1);
        }
    }
    lh_quasi_static_motions(&outlook->footing, planner->robot.num_actuators, count, share, &outlook->expected[first]);
}

/* What mechanics says each action does. Where the arm does not carry, its joints do not matter, and the crawlers'
 * digits, which are the lowest of an action's number, decide alone. On level ground the opposite of an action, its
 * number counted from the end, does the opposite. */
static void expect(const lh_planner *planner, lh_outlook *outlook) {
    const lh_planned *planned = &planner->planned;
    lh_twist *expected = outlook->expected;
    int32_t different = outlook->rest.braced ? planned->num_actions : planned->num_crawler_actions;
    int32_t found = outlook->footing.level ? (different + 1) / 2 : different;
    for (int32_t first = 0; first < found; first += LH_MOTIONS) {
        int32_t rest = found - first;
        expect_some(planner, first, rest < LH_MOTIONS ? rest : LH_MOTIONS, outlook);
    }
    for (int32_t a = found; a < different; a++) {
        const lh_twist *opposite = &expected[different - 1 - a];
        expected[a] = (lh_twist){-opposite->forward, -opposite->sideways, -opposite->turn};
    }
    for (int32_t a = different; a < planned->num_actions; a++) {
        expected[a] = expected[a - different];
    }
}

void lh_planning_look(lh_planner *planner, const float *angle) {
    lh_outlook *outlook = &planner->outlook;
    float joint_angle[LH_MAX_ACTUATORS];
    find_rest(planner, angle, joint_angle, &outlook->rest);
    if (planner->config.mechanics) {
        lh_footing_find(&planner->robot, joint_angle, &outlook->rest, planner->up, planner->planned.travel, FRICTION,
                        &outlook->footing);
        expect(planner, outlook);
    }
    lh_motion_model_gather(&planner->learned.model, angle, outlook->sums);
}

/* By mechanics and measurements. */
static lh_motion predict(const lh_planner *planner, int32_t action) {
    const lh_twist *expected = &planner->outlook.expected[action];
    lh_motion motion = {expected->forward, expected->sideways, expected->turn, 1.0f};
    lh_motion_model_correct(&planner->learned.model, &planner->outlook.sums[action], &motion);
    return motion;
}

/* The course after a motion, and the reward for it but for the cost of the posture. sine and cosine are those of the
 * heading error before. */
static float advance(const lh_planner *planner, const lh_motion *motion, float sine, float cosine, lh_course *course) {
    float along = motion->forward * cosine - motion->sideways * sine;
    float across = motion->forward * sine + motion->sideways * cosine;
    float half = 0.5f * motion->turn; /* small: the way is along the heading midway */
    course->lateral += across + half * along;
    course->heading += motion->turn;
    const lh_reward_config *reward = &planner->task.reward;
    return reward->forward * (along - half * across) - reward->sideways * lh_magnitude(motion->sideways) -
           steering_cost(planner, lh_course_steering(*course));
}

/* Raises best[LH_STEERINGS] to what `motion` is worth: it happens twice, as nodes are two decisions apart, and leads to
 * `next`. The steering error is taken to be one of heading. */
static void compare(const lh_planner *planner, const lh_motion *motion, int32_t next, float *best) {
    const lh_posture_values *values = &planner->learned.values;
    const float discount = planner->config.discount_rate;
    const float cost = lh_posture_node_cost(values, next) * (1.0f + discount);
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        float before = lh_posture_steering(k);
        lh_course course = {before, 0.0f};
        float reward = advance(planner, motion, lh_posture_sine(k), lh_posture_cosine(k), &course);
        float after = lh_course_steering(course);
        float later = after + after - before;
        float again = reward + steering_cost(planner, after) - steering_cost(planner, later);
        float value =
            reward + discount * again - cost + discount * discount * lh_posture_node_value(values, next, k, later);
        best[k] = value > best[k] ? value : best[k];
    }
}

void lh_planning_back_up(lh_planner *planner, int32_t node) {
    lh_posture_values *values = &planner->learned.values;
    float angle[LH_PLANNED_JOINTS];
    lh_posture_angles(values, node, angle);
    lh_planning_look(planner, angle);
    lh_posture_set_cost(values, node, standing_cost(planner, planner->outlook.rest.margin));
    float best[LH_STEERINGS];
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        best[k] = -FLT_MAX;
    }
    for (int32_t a = 0; a < planner->planned.num_actions; a++) {
        int32_t next = lh_posture_neighbour(values, node, lh_planned_joint_levels(&planner->planned, a));
        if (next != LH_NO_NODE && a != lh_planned_still(&planner->planned)) {
            lh_motion motion = predict(planner, a);
            compare(planner, &motion, motion.moved < JAMMED ? node : next, best);
        }
    }
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        lh_posture_set_value(values, node, k, best[k]);
    }
}

void lh_planning_back_up_in_turn(lh_planner *planner, int32_t count) {
    int32_t *turn = &planner->learned.turn;
    for (int32_t i = 0; i < count; i++) {
        lh_planning_back_up(planner, *turn);
        *turn = *turn + 1 < planner->learned.values.num_nodes ? *turn + 1 : 0;
    }
}

void lh_planning_consider(const lh_planner *planner, const float *angle, lh_course course, int32_t action,
                          lh_option *option) {
    const lh_posture_values *values = &planner->learned.values;
    lh_motion motion = predict(planner, action);
    option->action = action;
    option->expected = planner->outlook.expected[action];
    option->course = course;
    option->reward = advance(planner, &motion, lh_sin(course.heading), lh_cos(course.heading), &option->course);
    lh_planned_move(&planner->planned, angle, action, motion.moved, option->angle);
    lh_cell cell;
    lh_posture_cell(values, option->angle, &cell);
    option->reward -= lh_posture_cost(values, &cell);
    option->value = option->reward +
                    planner->config.discount_rate * lh_posture_value(values, &cell, lh_course_steering(option->course));
}

/* Value of the best action that follows. */
static float look_further(lh_planner *planner, const lh_option *from) {
    lh_planning_look(planner, from->angle);
    float best = -FLT_MAX;
    for (int32_t a = 0; a < planner->planned.num_actions; a++) {
        if (lh_planned_allows(&planner->planned, from->angle, a)) {
            lh_option next;
            lh_planning_consider(planner, from->angle, from->course, a, &next);
            best = next.value > best ? next.value : best;
        }
    }
    return best;
}

/* Inserts an option into the best ones, which are in falling order, if it is one of them; their new number. */
static int32_t rank(lh_option *best, int32_t count, int32_t most, const lh_option *candidate) {
    if (count == most && candidate->value <= best[count - 1].value) {
        return count;
    }
    int32_t place = count < most ? count : most - 1;
    for (; place > 0 && best[place - 1].value < candidate->value; place--) {
        best[place] = best[place - 1];
    }
    best[place] = *candidate;
    return count < most ? count + 1 : most;
}

lh_option lh_planning_choose(lh_planner *planner, const float *angle, lh_course course, float caution) {
    lh_option *best = planner->best;
    lh_planning_consider(planner, angle, course, lh_planned_still(&planner->planned), &best[0]);
    int32_t count = 0;
    for (int32_t a = 0; a < planner->planned.num_actions; a++) {
        if (lh_planned_allows(&planner->planned, angle, a)) {
            lh_option candidate;
            lh_planning_consider(planner, angle, course, a, &candidate);
            float doubt = caution * KNOWN / (KNOWN + planner->outlook.sums[a].narrow_weight);
            candidate.reward -= doubt;
            candidate.value -= doubt;
            count = rank(best, count, planner->config.candidates, &candidate);
        }
    }
    int32_t chosen = 0;
    for (int32_t i = 0; count > 1 && i < count; i++) {
        best[i].value = best[i].reward + planner->config.discount_rate * look_further(planner, &best[i]);
        chosen = best[i].value > best[chosen].value ? i : chosen;
    }
    return best[chosen];
}
