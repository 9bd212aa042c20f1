#include "structs.h"

/* Members of *s, in the order of their declaration, which C++ wants; a member that is forgotten is a warning there
 * (-Wmissing-field-initializers), and test/embedded/arrays.sh compiles as C++, too. */
#define REAL(member) initialiser_real(i, #member, s->member)
#define INTEGER(member) initialiser_integer(i, #member, s->member)
#define UNSIGNED(member) initialiser_unsigned(i, #member, s->member)
#define BOOL(member) initialiser_bool(i, #member, s->member)
#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define REALS(member) initialiser_reals(i, #member, s->member, COUNT(s->member))
#define INT16S(member) initialiser_int16s(i, #member, s->member, COUNT(s->member))
#define INT32S(member) initialiser_int32s(i, #member, s->member, COUNT(s->member))
#define UINT32S(member) initialiser_uint32s(i, #member, s->member, COUNT(s->member))

static void put_vec3(initialiser *i, const char *member, const lh_vec3 *s) {
    initialiser_open(i, member);
    REAL(x), REAL(y), REAL(z);
    initialiser_close(i);
}

static void put_quat(initialiser *i, const char *member, const lh_quat *s) {
    initialiser_open(i, member);
    REAL(w), REAL(x), REAL(y), REAL(z);
    initialiser_close(i);
}

static void put_actuator(initialiser *i, const lh_actuator *s) {
    initialiser_open(i, NULL);
    initialiser_word(i, "kind", s->kind == LH_CRAWLER ? "LH_CRAWLER" : "LH_JOINT");
    REAL(low), REAL(high), REAL(effort_limit);
    initialiser_close(i);
}

static void put_link(initialiser *i, const lh_link *s) {
    initialiser_open(i, NULL);
    INTEGER(parent), INTEGER(actuator);
    put_vec3(i, "origin", &s->origin);
    put_quat(i, "rotation", &s->rotation);
    put_vec3(i, "axis", &s->axis);
    REAL(mass);
    put_vec3(i, "centre", &s->centre);
    initialiser_close(i);
}

static void put_support(initialiser *i, const lh_support *s) {
    initialiser_open(i, NULL);
    INTEGER(link);
    put_vec3(i, "point", &s->point);
    REAL(radius);
    initialiser_close(i);
}

void structs_robot(initialiser *i, const char *name, const lh_robot *s) {
    initialiser_begin(i, "lh_robot", name);
    INTEGER(num_actuators), INTEGER(num_links), INTEGER(num_supports);
    initialiser_open(i, "actuators");
    for (int32_t k = 0; k < s->num_actuators; k++) {
        put_actuator(i, &s->actuators[k]);
    }
    initialiser_close(i);
    initialiser_open(i, "links");
    for (int32_t k = 0; k < s->num_links; k++) {
        put_link(i, &s->links[k]);
    }
    initialiser_close(i);
    initialiser_open(i, "supports");
    for (int32_t k = 0; k < s->num_supports; k++) {
        put_support(i, &s->supports[k]);
    }
    initialiser_close(i);
    initialiser_end(i);
}

static void put_shape(initialiser *i, const lh_shape *s) {
    initialiser_open(i, NULL);
    put_vec3(i, "centre", &s->centre);
    put_quat(i, "rotation", &s->rotation);
    put_vec3(i, "half", &s->half);
    REAL(radius), INTEGER(link), BOOL(disc);
    initialiser_close(i);
}

void structs_shapes(initialiser *i, const char *name, const lh_shapes *s, int32_t num_links) {
    initialiser_begin(i, "lh_shapes", name);
    INTEGER(count);
    initialiser_uint32s(i, "may_meet", s->may_meet, (size_t)num_links);
    initialiser_open(i, "shape");
    for (int32_t k = 0; k < s->count || k == 0; k++) { /* an array is not initialised by nothing */
        put_shape(i, &s->shape[k]);
    }
    initialiser_close(i);
    initialiser_end(i);
}

void structs_controlled(initialiser *i, const char *name, const lh_controlled *s) {
    initialiser_begin(i, "lh_controlled", name);
    INTEGER(count), INT32S(index);
    initialiser_end(i);
}

static const char *path_kind(lh_path_kind kind) {
    switch (kind) {
        case LH_PATH_ROLLING:
            return "LH_PATH_ROLLING";
        case LH_PATH_AHEAD:
            return "LH_PATH_AHEAD";
        case LH_PATH_WAYPOINTS:
            return "LH_PATH_WAYPOINTS";
    }
    return NULL;
}

static const char *learner_kind(lh_learner_kind kind) {
    switch (kind) {
        case LH_Q_LEARNING:
            return "LH_Q_LEARNING";
        case LH_PLANNER:
            return "LH_PLANNER";
    }
    return NULL;
}

static void put_point(initialiser *i, const lh_point2 *s) {
    initialiser_open(i, NULL);
    REAL(x), REAL(y);
    initialiser_close(i);
}

static void put_path_config(initialiser *i, const lh_path_config *s) {
    initialiser_open(i, "path");
    initialiser_word(i, "kind", path_kind(s->kind));
    INTEGER(num_waypoints);
    initialiser_open(i, "waypoint");
    for (int32_t k = 0; k < s->num_waypoints || k == 0; k++) {
        put_point(i, &s->waypoint[k]);
    }
    initialiser_close(i);
    initialiser_close(i);
}

static void put_reward_config(initialiser *i, const lh_reward_config *s) {
    initialiser_open(i, "reward");
    REAL(forward), REAL(sideways), REAL(turn), BOOL(heading_error), REAL(goal), REAL(stability), REAL(tumble);
    initialiser_close(i);
}

static void put_episode_config(initialiser *i, const lh_episode_config *s) {
    initialiser_open(i, "episode");
    REAL(goal_distance), INTEGER(step_limit), REAL(tumble_tilt), INTEGER(reset_every);
    initialiser_close(i);
}

static void put_task_config(initialiser *i, const lh_task_config *s) {
    initialiser_open(i, "task");
    REAL(crawler_speed), REAL(joint_speed);
    put_reward_config(i, &s->reward);
    put_episode_config(i, &s->episode);
    put_path_config(i, &s->path);
    initialiser_close(i);
}

static void put_network_config(initialiser *i, const lh_network_config *s) {
    initialiser_open(i, "network");
    INTEGER(units), INTEGER(inputs);
    REAL(rate_weight), REAL(rate_width), REAL(rate_centre);
    REAL(initial_weight), REAL(initial_width), REAL(width_floor), REAL(weight_limit), BOOL(exact_gradient);
    initialiser_close(i);
}

static void put_q_learning_config(initialiser *i, const lh_q_learning_config *s) {
    initialiser_open(i, "q_learning");
    REAL(learning_rate), REAL(discount_rate), REAL(temperature_floor);
    put_network_config(i, &s->network);
    initialiser_close(i);
}

static void put_planner_config(initialiser *i, const lh_planner_config *s) {
    initialiser_open(i, "planner");
    REAL(decision_period), REAL(discount_rate), BOOL(mechanics);
    REAL(steering), REAL(unsafe), REAL(caution), REAL(random_share);
    INTEGER(candidates), INTEGER(sweeps), INTEGER(backups);
    initialiser_close(i);
}

static void put_learner_config(initialiser *i, const lh_learner_config *s) {
    initialiser_open(i, "learner");
    initialiser_word(i, "kind", learner_kind(s->kind));
    UNSIGNED(seed), BOOL(learn), BOOL(greedy);
    put_q_learning_config(i, &s->q_learning);
    put_planner_config(i, &s->planner);
    initialiser_close(i);
}

static void put_motion_limit(initialiser *i, const char *member, const lh_motion_limit *s) {
    initialiser_open(i, member);
    REAL(speed), REAL(acceleration);
    initialiser_close(i);
}

static void put_jump_limits(initialiser *i, const lh_jump_limits *s) {
    initialiser_open(i, "slack");
    REAL(position), REAL(attitude), REAL(joint);
    initialiser_close(i);
}

static void put_monitor_config(initialiser *i, const lh_monitor_config *s) {
    initialiser_open(i, "monitor");
    BOOL(active), REAL(period);
    put_motion_limit(i, "crawler", &s->crawler);
    put_motion_limit(i, "joint", &s->joint);
    REAL(stop_clearance), REAL(margin_floor), REAL(collision_clearance), REAL(tilt);
    put_jump_limits(i, &s->slack);
    initialiser_close(i);
}

void structs_config(initialiser *i, const char *name, const lh_config *s) {
    initialiser_begin(i, "lh_config", name);
    put_task_config(i, &s->task);
    put_learner_config(i, &s->learner);
    put_monitor_config(i, &s->monitor);
    initialiser_end(i);
}

static void put_network(initialiser *i, const lh_network *s) {
    initialiser_open(i, "network");
    INTEGER(units), INTEGER(inputs), REALS(weight), REALS(width);
    initialiser_open(i, "centre");
    for (int32_t k = 0; k < s->inputs; k++) {
        initialiser_reals(i, NULL, s->centre[k], COUNT(s->centre[k]));
    }
    initialiser_close(i);
    initialiser_close(i);
}

static void put_random(initialiser *i, const lh_random *r) {
    initialiser_open(i, "random");
    initialiser_uint32s(i, "s", r->s, COUNT(r->s));
    initialiser_close(i);
}

static void put_held(initialiser *i, const lh_held *s) {
    initialiser_open(i, "held");
    UNSIGNED(weights), UNSIGNED(widths), UNSIGNED(centres);
    initialiser_close(i);
}

static void put_q_learned(initialiser *i, const lh_q_learned *s) {
    initialiser_open(i, "q_learning");
    put_network(i, &s->network);
    put_random(i, &s->random);
    put_held(i, &s->held);
    UNSIGNED(floored);
    initialiser_close(i);
}

static void put_motion_model(initialiser *i, const lh_motion_model *s) {
    initialiser_open(i, "model");
    INTEGER(num_actions), INTEGER(num_joints), REALS(low), REALS(width), REAL(prior_weight), INTEGER(num_samples);
    initialiser_open(i, "posture");
    for (size_t k = 0; k < COUNT(s->posture); k++) {
        initialiser_int16s(i, NULL, s->posture[k], COUNT(s->posture[k]));
    }
    initialiser_close(i);
    initialiser_open(i, "motion");
    for (size_t k = 0; k < COUNT(s->motion); k++) {
        initialiser_int16s(i, NULL, s->motion[k], COUNT(s->motion[k]));
    }
    initialiser_close(i);
    INT16S(action), INT16S(count), INT32S(updated);
    initialiser_close(i);
}

static void put_posture_values(initialiser *i, const lh_posture_values *s) {
    initialiser_open(i, "values");
    INTEGER(num_joints), INTEGER(num_nodes), INT32S(count), REALS(low), REALS(spacing);
    initialiser_open(i, "value");
    for (int32_t k = 0; k < s->num_nodes; k++) {
        initialiser_int16s(i, NULL, s->value[k], COUNT(s->value[k]));
    }
    initialiser_close(i);
    INT16S(cost);
    initialiser_close(i);
}

static void put_planner_learned(initialiser *i, const lh_planner_learned *s) {
    initialiser_open(i, "planner");
    put_motion_model(i, &s->model);
    put_posture_values(i, &s->values);
    put_random(i, &s->random);
    put_vec3(i, "ground", &s->ground);
    INTEGER(turn), INTEGER(decisions);
    initialiser_close(i);
}

void structs_learned(initialiser *i, const char *name, const lh_learned *s) {
    initialiser_begin(i, "lh_learned", name);
    initialiser_word(i, "kind", learner_kind(s->kind));
    initialiser_open(i, "as");
    switch (s->kind) {
        case LH_Q_LEARNING:
            put_q_learned(i, &s->as.q_learning);
            break;
        case LH_PLANNER:
            put_planner_learned(i, &s->as.planner);
            break;
    }
    initialiser_close(i);
    initialiser_end(i);
}
