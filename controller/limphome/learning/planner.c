#include "limphome/learning/planner.h"

#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/body/rest.h"
#include "limphome/learning/planning.h"

#define PRIOR_WEIGHT 1.0f   /* of what mechanics says against measurements nearby [measurements] */
#define GROUND_RATE 0.05f   /* share of a new reading of the ground's slope in that known so far */
#define LEAST_COMMAND 0.02f /* joint motion below it does not tell whether the arm is jammed [rad] */
#define PROGRESS 0.05f      /* towards the goal line that counts [m] */
#define STALLED 25          /* decisions without it, after which chance is to help */
#define STALLED_SHARE 0.3f  /* of actions at random from then on */

/* Widths of the kernel of the motion model along the planned joints [rad]: the nearer to the tip of the arm, the less a
 * joint's angle changes; the boom decides whether the arm carries. */
static const float kernel_width[LH_PLANNED_JOINTS] = {0.45f, 0.3f, 0.4f};

static const lh_vec3 vertical = {0.0f, 0.0f, 1.0f};

lh_planner_config lh_planner_config_default(void) {
    return (lh_planner_config){
        .decision_period = 0.5f,
        .discount_rate = 0.99f,
        .mechanics = true,
        .steering = 1.5f,
        .unsafe = 3.0f,
        .caution = 1.0f,
        .random_share = 0.01f,
        .candidates = 5,
        .sweeps = 10,
        .backups = 8,
    };
}

static bool is_count(int32_t x, int32_t low, int32_t high) {
    return x >= low && x <= high;
}

lh_error lh_planner_config_validate(const lh_planner_config *config) {
    if (!lh_within(config->discount_rate, 0.0f, LH_DISCOUNT_RATE_MAX)) {
        return LH_ERROR_RATE;
    }
    bool good = lh_within(config->decision_period, LH_DECISION_PERIOD_MIN, LH_DECISION_PERIOD_MAX) &&
                lh_within(config->steering, 0.0f, LH_PLANNER_WEIGHT_MAX) &&
                lh_within(config->unsafe, 0.0f, LH_PLANNER_WEIGHT_MAX) &&
                lh_within(config->caution, 0.0f, LH_PLANNER_WEIGHT_MAX) &&
                lh_within(config->random_share, 0.0f, 1.0f) && is_count(config->candidates, 1, LH_CANDIDATES_MAX) &&
                is_count(config->sweeps, 0, LH_SWEEPS_MAX) && is_count(config->backups, 0, LH_BACKUPS_MAX);
    return good ? LH_OK : LH_ERROR_PLANNER;
}

lh_error lh_planner_init(lh_planner *planner, const lh_planner_config *config, const lh_task *task, uint64_t seed) {
    lh_error error = lh_planner_config_validate(config);
    if (error != LH_OK) {
        return error;
    }
    memset(planner, 0, sizeof *planner); /* not by a literal, which would lie on the stack */
    planner->config = *config;
    planner->task = task->config;
    planner->robot = task->robot;
    lh_planned_init(&planner->planned, task, config->decision_period);

    const lh_planned *planned = &planner->planned;
    lh_planner_learned *learned = &planner->learned;
    lh_motion_model_init(&learned->model, planned->num_actions, planned->num_joints, planned->low, kernel_width,
                         PRIOR_WEIGHT);
    /* two decisions from node to node */
    lh_posture_values_init(&learned->values, planned->num_joints, planned->low, planned->high,
                           2.0f * task->config.joint_speed * config->decision_period);
    lh_random_init(&learned->random, seed);
    learned->ground = vertical;
    planner->up = vertical;
    planner->node = LH_NO_NODE;
    lh_planning_assess(planner);
    for (int32_t i = 0; i < config->sweeps; i++) {
        lh_planning_back_up_in_turn(planner, learned->values.num_nodes);
    }
    return LH_OK;
}

void lh_planner_keep_clear(lh_planner *planner, float clearance) {
    float *own = &planner->planned.clearance;
    *own = clearance > *own ? clearance : *own;
}

void lh_planner_begin(lh_planner *planner) {
    planner->acting = false;
    planner->node = LH_NO_NODE;
}

/* The share of the joint motion of `action` that has happened in the step under way, up to the joints' limits. */
static float share_moved(const lh_planner *planner, int32_t action, const float *angle) {
    const lh_planned *planned = &planner->planned;
    float goal[LH_PLANNED_JOINTS];
    lh_planned_move(planned, planner->angle, action, 1.0f, goal);
    float commanded = 0.0f;
    float achieved = 0.0f;
    for (int32_t k = 0; k < planned->num_joints; k++) {
        float from = planner->angle[k];
        float to = lh_clip(goal[k], planned->low[k], planned->high[k]);
        commanded += lh_magnitude(to - from);
        achieved += to > from ? angle[k] - from : (to < from ? from - angle[k] : 0.0f);
    }
    float share = commanded > LEAST_COMMAND ? achieved / commanded : 1.0f;
    return lh_clip(share, 0.0f, 1.0f);
}

/* Takes in by how much the step under way did something else than mechanics said of `action`. */
static void learn_of(lh_planner *planner, int32_t action, const lh_twist *expected, const lh_pose2 *now,
                     const float *angle) {
    const lh_pose2 *start = &planner->pose;
    float dx = now->x - start->x;
    float dy = now->y - start->y;
    float turn = lh_wrap_angle(now->heading - start->heading);
    float sine = lh_sin(start->heading + 0.5f * turn);
    float cosine = lh_cos(start->heading + 0.5f * turn);
    lh_motion difference = {
        .forward = cosine * dx + sine * dy - expected->forward,
        .sideways = cosine * dy - sine * dx - expected->sideways,
        .turn = turn - expected->turn,
        .moved = share_moved(planner, action, angle) - 1.0f,
    };
    lh_motion_model_insert(&planner->learned.model, action, planner->angle, &difference, planner->learned.decisions);
}

/* What was executed did that; and so does what was chosen where something else is executed in its place, or it would be
 * chosen for ever. */
static void learn(lh_planner *planner, const lh_pose2 *now, const float *angle) {
    learn_of(planner, planner->executed, &planner->expected_executed, now, angle);
    if (planner->action != planner->executed) {
        learn_of(planner, planner->action, &planner->expected, now, angle);
    }
}

/* The slope of the ground, from how the body lies on it. */
static void watch_ground(lh_planner *planner, const lh_observed *observed) {
    lh_rest rest;
    lh_rest_find(&planner->robot, observed->joint_angle, vertical, &rest);
    lh_vec3 normal = lh_quat_rotate(observed->attitude, rest.normal);
    if (normal.z > LH_LEAST_GROUND) {
        lh_vec3 *ground = &planner->learned.ground;
        lh_vec3 moved = lh_vec3_add(*ground, lh_vec3_scale(lh_vec3_sub(normal, *ground), GROUND_RATE));
        *ground = lh_vec3_scale(moved, 1.0f / lh_vec3_norm(moved));
    }
}

/* The vertical in the frame of the ground, with x along `direction` [rad]. */
static lh_vec3 vertical_along(const lh_planner *planner, float direction) {
    lh_vec3 normal = lh_quat_rotate(lh_quat_about(vertical, -direction), planner->learned.ground);
    return lh_quat_rotate(lh_rest_upright(normal), vertical);
}

static void watch_progress(lh_planner *planner, const lh_observed *observed) {
    if (observed->step == 0 || observed->goal_distance < planner->best_distance - PROGRESS) {
        planner->best_distance = observed->goal_distance;
        planner->stalled = 0;
    } else if (planner->stalled < STALLED) {
        planner->stalled++;
    }
}

/* Any of the actions that are allowed; to stand still if there is none. */
static int32_t choose_at_random(lh_planner *planner, const float *angle) {
    const lh_planned *planned = &planner->planned;
    int32_t count = 0;
    for (int32_t a = 0; a < planned->num_actions; a++) {
        count += lh_planned_allows(planned, angle, a);
    }
    int32_t chosen = lh_planned_still(planned);
    int32_t rest = (int32_t)(lh_random_uniform(&planner->learned.random) * (float)count);
    for (int32_t a = 0; a < planned->num_actions && rest >= 0; a++) {
        if (lh_planned_allows(planned, angle, a)) {
            chosen = a;
            rest--;
        }
    }
    return chosen;
}

static lh_option choose(lh_planner *planner, const float *angle, lh_course course, bool greedy) {
    lh_planning_look(planner, angle);
    float random_share = planner->stalled == STALLED ? STALLED_SHARE : (greedy ? 0.0f : planner->config.random_share);
    if (random_share > 0.0f && lh_random_uniform(&planner->learned.random) < random_share) {
        lh_option any;
        lh_planning_consider(planner, angle, course, choose_at_random(planner, angle), &any);
        return any;
    }
    return lh_planning_choose(planner, angle, course, greedy ? planner->config.caution : 0.0f);
}

void lh_planner_step(lh_planner *planner, const lh_observed *observed, bool learns, bool greedy, lh_choice *choice) {
    *choice = (lh_choice){.learned = false};
    lh_planner_learned *learned = &planner->learned;
    float angle[LH_PLANNED_JOINTS];
    memcpy(planner->joint_angle, observed->joint_angle, sizeof planner->joint_angle);
    lh_planned_angles(&planner->planned, planner->joint_angle, angle);

    /* a robot that falls does not move as it would again */
    if (learns && observed->stepped && planner->acting && observed->outcome != LH_OUTCOME_TUMBLE) {
        learn(planner, &observed->pose, angle);
        choice->learned = true;
    }
    if (learned->decisions < LH_LAST_DECISION) {
        learned->decisions++;
    }
    watch_progress(planner, observed);
    if (observed->reset) {
        return;
    }
    watch_ground(planner, observed);
    lh_course course = {observed->heading_error, observed->lateral_error};
    planner->up = vertical_along(planner, observed->pose.heading - observed->heading_error);
    lh_cell cell;
    lh_posture_cell(&learned->values, angle, &cell);
    int32_t node = lh_posture_nearest(&cell);
    if (planner->node != LH_NO_NODE) {
        lh_planning_back_up(planner, planner->node); /* where something has just been measured */
    }
    lh_planning_back_up(planner, node);
    lh_planning_back_up_in_turn(planner, planner->config.backups);

    lh_option chosen = choose(planner, angle, course, greedy);
    choice->action = lh_planned_joint_action(&planner->planned, chosen.action);
    choice->q = chosen.value;
    choice->q_max = chosen.value;
    choice->probability = 1.0f;
    planner->action = chosen.action;
    planner->expected = chosen.expected;
    planner->executed = planner->action;
    planner->expected_executed = planner->expected;
    planner->acting = true;
    planner->pose = observed->pose;
    memcpy(planner->angle, angle, sizeof angle);
    planner->node = node;
}

void lh_planner_executed(lh_planner *planner, int32_t action) {
    planner->executed = lh_planned_action(&planner->planned, action);
    lh_planning_look(planner, planner->angle); /* the choice has looked further */
    planner->expected_executed = planner->outlook.expected[planner->executed];
}

void lh_planner_save(const lh_planner *planner, lh_planner_learned *learned) {
    *learned = planner->learned;
}

lh_error lh_planner_restore(lh_planner *planner, const lh_planner_learned *saved) {
    lh_planner_learned *learned = &planner->learned;
    lh_vec3 ground = saved->ground;
    bool good = lh_motion_model_fits(&saved->model, &learned->model) &&
                lh_posture_values_fit(&saved->values, &learned->values) && saved->turn >= 0 &&
                saved->turn < learned->values.num_nodes && saved->decisions >= 0 &&
                saved->decisions <= LH_LAST_DECISION && lh_within(ground.x, -1.0f, 1.0f) &&
                lh_within(ground.y, -1.0f, 1.0f) && lh_within(ground.z, 0.999f * LH_LEAST_GROUND, 1.001f) &&
                lh_within(lh_vec3_norm(ground), 0.999f, 1.001f);
    if (!good) {
        return LH_ERROR_PLANNER;
    }
    lh_random random;
    lh_error error = lh_random_restore(&random, saved->random.s);
    if (error != LH_OK) {
        return error;
    }
    *learned = *saved;
    lh_planner_begin(planner);
    return LH_OK;
}
