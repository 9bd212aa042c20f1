#include "limphome/learning/planner.h"

#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/body/rest.h"

#define JAMMED 0.6f

lh_planner_config lh_planner_config_default(void) {
    return (lh_planner_config){
        .decision_period = 0.5f,
        .discount_rate = 0.99f,
        .curiosity = 0.3f,
        .curiosity_decay = 0.97f,
        .random_share = 0.0f,
        .stuck_share = 0.3f,
        .steering = 1.5f,
        .unsafe = 3.0f,
        .safe_margin = 0.02f,
        .width = {0.45f, 0.3f, 0.4f},
        .prior_weight = 1.0f,
        .physics = 1.0f,
        .ground_rate = 0.05f,
        .friction = 0.7f,
        .candidates = 10,
        .backups = 18,
        .imagined_steps = 20,
    };
}

lh_error lh_planner_config_validate(const lh_planner_config *config) {
    return config->decision_period > 0.0f ? LH_OK : LH_ERROR_RATE;
}

static float magnitude(float x) {
    return x < 0.0f ? -x : x;
}

static float clip(float x, float low, float high) {
    return x < low ? low : (x > high ? high : x);
}

/* At angle[]: rests, footing, sums */
static void look(lh_planner *p, const float *angle) {
    lh_outlook *o = &p->outlook;
    float full[LH_MAX_ACTUATORS];
    memcpy(full, p->joint_angle, sizeof full);
    lh_planned_set_angles(&p->planned, angle, full);
    lh_rest_find(&p->robot, full, p->up, p->task.support_tolerance, &o->rest);
    lh_footing_find(&p->robot, full, &o->rest, p->up, p->planned.travel, p->config.friction, &o->footing);
    lh_motion_model_gather(&p->model, angle, o->sums);
}

static lh_motion expect(lh_planner *p, int32_t action) {
    float share[LH_MAX_ACTUATORS] = {0.0f};
    for (int32_t k = 0; k < p->planned.count; k++) {
        share[p->planned.actuator[k]] = (float)(p->planned.level[action][k] - 1);
    }
    lh_twist t = {0.0f, 0.0f, 0.0f};
    if (p->config.physics > 0.0f) {
        t = lh_quasi_static_motion(&p->outlook.footing, p->robot.num_actuators, share);
    }
    return (lh_motion){t.forward, t.sideways, t.turn, 1.0f};
}

static lh_motion predict(lh_planner *p, int32_t action) {
    lh_motion motion = expect(p, action);
    lh_motion_model_correct(&p->model, &p->outlook.sums[action], &motion);
    return motion;
}

static float standing_cost(const lh_planner *p, float margin) {
    float lacking = clip(1.0f - margin / p->config.safe_margin, 0.0f, 3.0f);
    return p->task.reward.stability * lh_exp(-margin) + p->config.unsafe * lacking;
}

lh_error lh_planner_init(lh_planner *p, const lh_planner_config *config, const lh_task *task, uint64_t seed) {
    memset(p, 0, sizeof *p);
    p->config = *config;
    p->task = task->config;
    p->robot = task->robot;
    lh_planned_init(&p->planned, task, config->decision_period);
    const lh_planned *planned = &p->planned;
    lh_motion_model_init(&p->model, planned->num_actions, planned->num_joints, planned->low, config->width,
                         config->prior_weight);
    lh_posture_values_init(&p->values, planned->num_joints, planned->low, planned->high,
                           2.0f * task->config.joint_speed * config->decision_period);
    lh_random_init(&p->random, seed);
    p->curiosity = config->curiosity;
    p->pace = 1e9f;
    p->best_pace = 1e9f;
    p->ground = (lh_vec3){0.0f, 0.0f, 1.0f};
    p->up = p->ground;
    for (int32_t node = 0; node < p->values.num_nodes; node++) {
        float angle[LH_PLANNED_JOINTS];
        float full[LH_MAX_ACTUATORS] = {0.0f};
        lh_rest rest;
        lh_posture_angles(&p->values, node, angle);
        lh_planned_set_angles(planned, angle, full);
        lh_rest_find(&p->robot, full, p->up, p->task.support_tolerance, &rest);
        lh_posture_set_cost(&p->values, node, standing_cost(p, rest.margin));
    }
    return LH_OK;
}

void lh_planner_begin(lh_planner *p) {
    p->acting = false;
}

/* vertical in the frame of the ground, x along the line */
static lh_vec3 line_up(const lh_planner *p, float direction) {
    lh_quat turn = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, -direction);
    lh_vec3 normal = lh_quat_rotate(turn, p->ground);
    return lh_quat_rotate(lh_rest_upright(normal), (lh_vec3){0.0f, 0.0f, 1.0f});
}

static float steering_cost(const lh_planner *p, float error) {
    float size = magnitude(error);
    return p->config.steering * (size < 0.1f ? size * size / 0.1f : 2.0f * size - 0.1f);
}

/* Where the robot is against its line, and the heading's direction. */
typedef struct course {
    float heading; /* error [rad] */
    float lateral; /* error [m] */
} course;

static float steering(course at) {
    return at.heading + LH_STEERING_GAIN * at.lateral;
}

/* One planned decision; returns the reward without the cost of the posture. sine and cosine are those of the heading
 * error before. */
static float advance(const lh_planner *p, const lh_motion *m, float sine, float cosine, course *at) {
    float along = m->forward * cosine - m->sideways * sine;
    float across = m->forward * sine + m->sideways * cosine;
    float half = 0.5f * m->turn; /* small: the path is along the heading midway */
    at->lateral += across + half * along;
    at->heading += m->turn;
    return p->task.reward.forward * (along - half * across) - p->task.reward.sideways * magnitude(m->sideways) -
           steering_cost(p, steering(*at));
}

/* Value of a node, and the best action in each column, -1 none. */
static void back_up(lh_planner *p, int32_t node, int32_t *best_action) {
    float angle[LH_PLANNED_JOINTS];
    lh_posture_angles(&p->values, node, angle);
    look(p, angle);
    lh_posture_set_cost(&p->values, node, standing_cost(p, p->outlook.rest.margin));
    float best[LH_STEERINGS];
    float sine[LH_STEERINGS];
    float cosine[LH_STEERINGS];
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        best[k] = -1e9f;
        best_action[k] = -1;
        sine[k] = lh_sin(lh_posture_steering(k));
        cosine[k] = lh_cos(lh_posture_steering(k));
    }
    const float discount = p->config.discount_rate;
    for (int32_t a = 0; a < p->planned.num_actions; a++) {
        int32_t next = lh_posture_neighbour(&p->values, node, lh_planned_joint_levels(&p->planned, a));
        if (a == p->planned.num_actions / 2 || next == LH_NO_NODE) {
            continue;
        }
        lh_motion m = predict(p, a);
        next = m.moved < JAMMED ? node : next;
        const float cost = (float)p->values.cost[next] * (1.0f / 1024.0f);
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            course at = {lh_posture_steering(k), 0.0f};
            float reward = advance(p, &m, sine[k], cosine[k], &at) - cost;
            float eps = steering(at);
            float change = eps - lh_posture_steering(k);
            float second = reward + steering_cost(p, eps) - steering_cost(p, eps + change);
            float value = reward + discount * second +
                          discount * discount * lh_posture_node_value(&p->values, next, eps + change);
            if (value > best[k]) {
                best[k] = value;
                best_action[k] = a;
            }
        }
    }
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        if (best_action[k] >= 0) {
            lh_posture_set_value(&p->values, node, k, best[k]);
        }
    }
}

static int32_t nearest_column(float eps) {
    int32_t best = 0;
    for (int32_t k = 1; k < LH_STEERINGS; k++) {
        best = magnitude(eps - lh_posture_steering(k)) < magnitude(eps - lh_posture_steering(best)) ? k : best;
    }
    return best;
}

static void plan(lh_planner *p, int32_t node, float eps) {
    int32_t best_action[LH_STEERINGS];
    if (p->node >= 0) {
        back_up(p, p->node, best_action);
    }
    back_up(p, node, best_action);
    int32_t at = node;
    for (int32_t i = 0; i < p->config.imagined_steps; i++) {
        int32_t a = best_action[nearest_column(eps)];
        if (a < 0) {
            break;
        }
        lh_motion m = predict(p, a); /* the outlook is still that of the node */
        course c = {eps, 0.0f};
        advance(p, &m, lh_sin(eps), lh_cos(eps), &c);
        eps = clip(eps + 2.0f * (steering(c) - eps), -1.0f, 1.0f);
        at = m.moved < JAMMED ? at : lh_posture_neighbour(&p->values, at, lh_planned_joint_levels(&p->planned, a));
        back_up(p, at, best_action);
    }
    for (int32_t i = 0; i < p->config.backups; i++) {
        back_up(p, p->round, best_action);
        p->round = (p->round + 1) % p->values.num_nodes;
    }
}

/* An action looked into: where it leads, and what it is worth. */
typedef struct option {
    int32_t action;
    float reward; /* of the first step */
    float value;
    course course;
    float angle[LH_PLANNED_JOINTS];
} option;

#define MAX_CANDIDATES 16

static bool consider(lh_planner *p, const float *angle, const course *from, int32_t action, float curiosity,
                     option *o) {
    if (!lh_planned_allows(&p->planned, angle, action)) {
        return false;
    }
    lh_motion m = predict(p, action);
    o->action = action;
    o->course = *from;
    o->reward = advance(p, &m, lh_sin(from->heading), lh_cos(from->heading), &o->course);
    lh_planned_move(&p->planned, angle, action, m.moved, o->angle);
    lh_cell cell;
    lh_posture_cell(&p->values, o->angle, &cell);
    o->reward += curiosity * 0.1f / (0.1f + p->outlook.sums[action].narrow_weight) - lh_posture_cost(&p->values, &cell);
    o->value = o->reward + p->config.discount_rate * lh_posture_value(&p->values, &cell, steering(o->course));
    return true;
}

/* The value of the best action there. */
static float best_further(lh_planner *p, const option *from) {
    look(p, from->angle);
    float best = -1e9f;
    for (int32_t a = 0; a < p->planned.num_actions; a++) {
        option o;
        if (consider(p, from->angle, &from->course, a, 0.0f, &o)) {
            best = o.value > best ? o.value : best;
        }
    }
    return best;
}

static int32_t choose(lh_planner *p, const float *angle, const course *at, float curiosity, float *value_of) {
    look(p, angle);
    option top[MAX_CANDIDATES] = {{0}};
    int32_t count = 0;
    for (int32_t a = 0; a < p->planned.num_actions; a++) {
        option o;
        if (!consider(p, angle, at, a, curiosity, &o)) {
            continue;
        }
        int32_t place = count < p->config.candidates ? count++ : count - 1;
        if (place == p->config.candidates - 1 && count == p->config.candidates && top[place].value >= o.value &&
            top[place].value != 0.0f) {
            continue;
        }
        while (place > 0 && top[place - 1].value < o.value) {
            top[place] = top[place - 1];
            place--;
        }
        top[place] = o;
    }
    int32_t best = 0;
    if (p->config.candidates > 1) {
        for (int32_t i = 0; i < count; i++) {
            top[i].value = top[i].reward + p->config.discount_rate * best_further(p, &top[i]);
            best = top[i].value > top[best].value ? i : best;
        }
    }
    *value_of = top[best].value;
    return top[best].action;
}

/* What the action under way has done. */
static lh_motion measure(const lh_planner *p, const lh_pose2 *now, const float *angle) {
    lh_motion motion;
    float dx = now->x - p->pose.x;
    float dy = now->y - p->pose.y;
    motion.turn = lh_wrap_angle(now->heading - p->pose.heading);
    float middle = p->pose.heading + 0.5f * motion.turn;
    motion.forward = lh_cos(middle) * dx + lh_sin(middle) * dy;
    motion.sideways = lh_cos(middle) * dy - lh_sin(middle) * dx;
    float commanded = 0.0f;
    float achieved = 0.0f;
    float wanted[LH_PLANNED_JOINTS];
    lh_planned_move(&p->planned, p->angle, p->action, 1.0f, wanted);
    for (int32_t k = 0; k < p->planned.num_joints; k++) {
        float goal = clip(wanted[k], p->planned.low[k], p->planned.high[k]);
        commanded += magnitude(goal - p->angle[k]);
        achieved += goal > p->angle[k] ? angle[k] - p->angle[k] : (goal < p->angle[k] ? p->angle[k] - angle[k] : 0.0f);
    }
    motion.moved = commanded > 0.02f ? clip(achieved / commanded, 0.0f, 1.0f) : 1.0f;
    return motion;
}

static void watch_ground(lh_planner *p, const lh_observed *observed) {
    lh_rest rest;
    lh_rest_find(&p->robot, observed->joint_angle, (lh_vec3){0.0f, 0.0f, 1.0f}, p->task.support_tolerance, &rest);
    lh_vec3 normal = lh_quat_rotate(observed->attitude, rest.normal);
    if (normal.z < 0.5f) {
        return;
    }
    lh_vec3 moved = lh_vec3_add(p->ground, lh_vec3_scale(lh_vec3_sub(normal, p->ground), p->config.ground_rate));
    p->ground = lh_vec3_scale(moved, 1.0f / lh_vec3_norm(moved));
}

static void watch_progress(lh_planner *p, const lh_observed *observed) {
    if (observed->outcome != LH_OUTCOME_NONE) {
        p->curiosity *= p->config.curiosity_decay;
    }
    if (!observed->stepped || observed->outcome != LH_OUTCOME_NONE ||
        observed->goal_distance < p->best_distance - 0.05f) {
        p->best_distance = observed->goal_distance;
        p->stalled = 0;
    } else {
        p->stalled++;
    }
}

static int32_t random_action(lh_planner *p, const float *angle) {
    int16_t allowed[LH_PLANNED_ACTIONS];
    int32_t count = 0;
    for (int32_t a = 0; a < p->planned.num_actions; a++) {
        if (lh_planned_allows(&p->planned, angle, a)) {
            allowed[count++] = (int16_t)a;
        }
    }
    return allowed[(int32_t)(lh_random_uniform(&p->random) * (float)count)];
}

void lh_planner_step(lh_planner *p, const lh_observed *observed, bool learn, bool greedy, lh_choice *choice) {
    *choice = (lh_choice){.learned = false};
    float angle[LH_PLANNED_JOINTS];
    memcpy(p->joint_angle, observed->joint_angle, sizeof p->joint_angle);
    lh_planned_angles(&p->planned, p->joint_angle, angle);
    if (learn && observed->stepped && p->acting && observed->outcome != LH_OUTCOME_TUMBLE) {
        lh_motion motion = measure(p, &observed->pose, angle);
        motion.forward -= p->expected.forward;
        motion.sideways -= p->expected.sideways;
        motion.turn -= p->expected.turn;
        motion.moved -= p->expected.moved;
        lh_motion_model_insert(&p->model, p->action, p->angle, &motion, p->decisions);
        choice->learned = true;
    }
    p->decisions++;
    watch_progress(p, observed);
    if (observed->reset) {
        p->acting = false;
        return;
    }
    watch_ground(p, observed);
    course at = {observed->heading_error, observed->lateral_error};
    p->up = line_up(p, observed->pose.heading - at.heading);
    lh_cell cell;
    lh_posture_cell(&p->values, angle, &cell);
    int32_t node = lh_posture_nearest(&cell);
    if (!p->acting) {
        p->node = -1;
    }
    plan(p, node, clip(steering(at), -1.0f, 1.0f));
    float random_share = greedy ? 0.0f : p->config.random_share;
    if (p->stalled > 25) {
        random_share = p->config.stuck_share;
    }
    choice->probability = 1.0f;
    bool at_random = random_share > 0.0f && lh_random_uniform(&p->random) < random_share;
    p->action = at_random ? random_action(p, angle) : choose(p, angle, &at, greedy ? 0.0f : p->curiosity, &choice->q);
    choice->action = lh_planned_joint_action(&p->planned, p->action);
    choice->q_max = choice->q;
    look(p, angle);
    p->expected = expect(p, p->action);
    p->acting = true;
    p->pose = observed->pose;
    memcpy(p->angle, angle, sizeof angle);
    p->node = node;
}
