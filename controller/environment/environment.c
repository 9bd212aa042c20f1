#include "environment.h"

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "convert_robot.h"
#include "limphome/base/elementary.h"
#include "limphome/task/action.h"
#include "plant_link.h"
#include "robot_file.h"

_Static_assert((int)ENVIRONMENT_ERROR_LENGTH == (int)ERROR_LENGTH, "one room for reasons");

struct environment {
    settings settings;
    lh_robot robot;
    bool line; /* inputs tell of it */
    recording unrecorded;
    plant_link link;
    char error[ERROR_LENGTH];

    bool ready; /* the first state has told which actuators obey, so `task` is set up */
    lh_task task;
    bool asked;      /* for a reset, whose state has not come yet */
    int32_t episode; /* that begins there */
    limphome_robot_state_t state;
    lh_observed observed; /* what it told */
};

/* Where the robot is in an episode. */
typedef struct place {
    float goal_distance, lateral_error; /* [m] */
    float heading_error;                /* (-pi, pi] [rad] */
} place;

/* What a state tells, by name; `e`, `seen`, `ended` and `at` are in scope. */
#define VALUES(VALUE)                                                                                   \
    VALUE(reward, lh_reward_total(&seen->reward))                                                       \
    VALUE(reward_motion, seen->reward.motion)                                                           \
    VALUE(reward_goal, seen->reward.goal)                                                               \
    VALUE(reward_stability, seen->reward.stability)                                                     \
    VALUE(reward_tumble, seen->reward.tumble)                                                           \
    VALUE(stability_margin, seen->stability_margin)                                                     \
    VALUE(goal_distance, at->goal_distance)                                                             \
    VALUE(lateral_error, at->lateral_error)                                                             \
    VALUE(heading_error, at->heading_error)                                                             \
    VALUE(waypoint_distance, ended ? seen->summary.waypoint_distance : seen->waypoint_distance)         \
    VALUE(x, seen->pose.x)                                                                              \
    VALUE(y, seen->pose.y)                                                                              \
    VALUE(heading, seen->pose.heading)                                                                  \
    VALUE(episode_number, ended ? seen->summary.number : seen->episode)                                 \
    VALUE(step, ended ? seen->summary.steps : seen->step)                                               \
    VALUE(duration, (ended ? seen->summary.steps : seen->step) * e->settings.episode.decision_period_s) \
    VALUE(heading_change,                                                                               \
          ended ? seen->summary.heading_change : lh_wrap_angle(seen->pose.heading - e->task.episode.start.heading))

static const char *const NAMES =
#define VALUE(name, expression) #name ","
    VALUES(VALUE)
#undef VALUE
    ;

const char *environment_value_names(void) {
    return NAMES;
}

static bool read_robot(environment *e, const char *file) {
    robot_description *described = calloc(1, sizeof *described); /* too large for a comfortable stack frame */
    robot_report report = {0};
    const bool good = described != NULL && robot_file_read(file, NULL, described, &report) &&
                      convert_robot(described, &e->robot, e->error);
    if (!good) {
        fail_with(e->error, "%s", report.num_faults > 0 ? report.faults[0] : "no memory");
    }
    robot_report_free(&report);
    free(described);
    return good;
}

environment *environment_open(const char *config, const char *robot, const char *url, bool line,
                              char error[ENVIRONMENT_ERROR_LENGTH]) {
    error[0] = '\0';
    environment *e = calloc(1, sizeof *e);
    if (e == NULL) {
        fail_with(error, "no memory");
        return NULL;
    }
    e->line = line;
    e->settings = settings_default();
    if (settings_read(&e->settings, config, e->error) && settings_check(&e->settings, e->error) &&
        read_robot(e, robot) && plant_link_open(&e->link, url, &e->settings, &e->unrecorded, e->error)) {
        return e;
    }
    fail_with(error, "%s", e->error);
    free(e);
    return NULL;
}

void environment_close(environment *e) {
    bus_close(&e->link.bus);
    free(e);
}

const char *environment_error(const environment *e) {
    return e->error;
}

int32_t environment_num_inputs(const environment *e) {
    return e->ready ? e->task.controlled.count + 2 + (e->line ? 3 : 0) : 0;
}

int32_t environment_num_actions(const environment *e) {
    return e->ready ? lh_action_count(e->task.controlled.count) : 0;
}

void environment_reset(environment *e, int32_t episode) {
    plant_state forgotten; /* where a wait was given up */
    while (plant_link_take(&e->link, &forgotten)) {
    }
    e->episode = episode;
    e->asked = true;
    if (e->ready) { /* else the link asks the first plant that it hears */
        plant_link_reset(&e->link, episode);
    }
}

void environment_act(environment *e, int32_t action) {
    float velocity[LH_MAX_ACTUATORS] = {0};
    lh_task_velocities(&e->task, action, velocity);
    plant_link_command(&e->link, &e->state, velocity);
}

static void fill(const environment *e, const lh_observed *seen, bool ended, const place *at, float *inputs,
                 double *values) {
    memcpy(inputs, seen->inputs, (size_t)seen->num_inputs * sizeof *inputs);
    if (e->line) {
        float *more = inputs + seen->num_inputs;
        const float farthest = e->task.config.episode.goal_distance;
        int32_t clamped = 0;
        more[0] = lh_observation_scale(at->goal_distance, 0.0f, farthest, &clamped);
        more[1] = lh_observation_scale(at->lateral_error, -farthest, farthest, &clamped);
        more[2] = lh_observation_scale(at->heading_error, -LH_PI, LH_PI, &clamped);
    }
#define VALUE(name, expression) *values++ = (double)(expression);
    VALUES(VALUE)
#undef VALUE
}

static place place_in(const lh_episode *episode, const lh_pose2 *pose) {
    return (place){
        .goal_distance = lh_episode_distance(episode, pose),
        .lateral_error = lh_episode_lateral(episode, pose),
        .heading_error = lh_wrap_angle(pose->heading - episode->line.heading),
    };
}

static int result_of(lh_outcome outcome) {
    switch (outcome) {
        case LH_OUTCOME_GOAL:
            return ENVIRONMENT_GOAL;
        case LH_OUTCOME_TUMBLE:
            return ENVIRONMENT_TUMBLE;
        case LH_OUTCOME_TIMEOUT:
            return ENVIRONMENT_TIMEOUT;
        case LH_OUTCOME_NONE:
            break;
    }
    return ENVIRONMENT_GOES_ON;
}

/* Which actuators obey is known now. */
static bool begin_task(environment *e, const limphome_robot_state_t *state) {
    const lh_config config = convert_config(&e->settings);
    const lh_controlled controlled = convert_controlled(state);
    const lh_error error = lh_task_init(&e->task, &config.task, &e->robot, &controlled);
    e->ready = error == LH_OK;
    return e->ready || fail_with(e->error, "%s", lh_error_text(error));
}

static int take_in(environment *e, const plant_state *taken, float *inputs, double *values) {
    if (!e->ready && !begin_task(e, &taken->state)) {
        return ENVIRONMENT_FAILED;
    }
    const bool fault = taken->begins && !e->asked;
    if (taken->begins) {
        lh_task_begin(&e->task, fault ? e->task.episode.number : e->episode);
        e->asked = false;
    }
    if (taken->gap) {
        lh_task_gap(&e->task);
    }
    e->state = taken->state;
    const lh_episode before = e->task.episode;
    const lh_state sensed = convert_state(&taken->state);
    const lh_error error = lh_task_observe(&e->task, &sensed, &e->observed);
    if (error != LH_OK) {
        fail_with(e->error, "%s", lh_error_text(error));
        return ENVIRONMENT_FAILED;
    }
    const bool ended = e->observed.outcome != LH_OUTCOME_NONE;
    const place at = place_in(ended ? &before : &e->task.episode, &e->observed.pose);
    fill(e, &e->observed, ended, &at, inputs, values);
    return fault ? ENVIRONMENT_FAULT : result_of(e->observed.outcome);
}

int environment_wait(environment *e, double timeout, float *inputs, double *values) {
    const double end = bus_now() + timeout;
    double left = timeout;
    do {
        if (!plant_link_wait(&e->link, left)) {
            fail_with(e->error, "the bus is broken");
            return ENVIRONMENT_FAILED;
        }
        plant_link_answer(&e->link, e->episode);
        plant_state taken;
        if (plant_link_take(&e->link, &taken)) {
            return take_in(e, &taken, inputs, values);
        }
        left = end - bus_now();
    } while (left > 0);
    return ENVIRONMENT_WAITING;
}

bool environment_next(const environment *e, float *inputs, double *values) {
    const bool goes_on = e->observed.outcome != LH_OUTCOME_NONE && !e->observed.reset;
    if (goes_on) {
        lh_observed first = e->observed;
        first.reward = (lh_reward){0}; /* of the step before */
        const place at = place_in(&e->task.episode, &first.pose);
        fill(e, &first, false, &at, inputs, values);
    }
    return goes_on;
}
