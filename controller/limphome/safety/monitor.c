#include "limphome/safety/monitor.h"

#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/safety/forecast.h"
#include "limphome/task/action.h"

#define COASTING 0.05f /* a joint goes on as fast for so long after it is told to stop, no longer [s] */

lh_monitor_config lh_monitor_config_default(void) {
    return (lh_monitor_config){
        .active = false,
        .period = 0.5f,
        .crawler = {.speed = 0.5f, .acceleration = 2.0f},
        .joint = {.speed = 0.5f, .acceleration = 2.0f},
        .stop_clearance = 0.0f,
        .margin_floor = 0.0f,
        .collision_clearance = 0.02f,
        .tilt = LH_PI / 3.0f,
        .slack = {.position = 1.0f, .attitude = 1.0f, .joint = 0.5f},
    };
}

static bool is_good_limit(const lh_motion_limit *limit) {
    return lh_within(limit->speed, 0.0f, LH_SPEED_LIMIT_MAX) &&
           lh_within(limit->acceleration, 0.0f, LH_ACCELERATION_LIMIT_MAX);
}

lh_error lh_monitor_config_validate(const lh_monitor_config *config) {
    bool good =
        lh_within(config->period, LH_MONITOR_PERIOD_MIN, LH_MONITOR_PERIOD_MAX) && is_good_limit(&config->crawler) &&
        is_good_limit(&config->joint) && lh_within(config->stop_clearance, 0.0f, LH_STOP_CLEARANCE_MAX) &&
        lh_within(config->margin_floor, LH_MARGIN_FLOOR_MIN, LH_MARGIN_FLOOR_MAX) &&
        lh_within(config->collision_clearance, 0.0f, LH_COLLISION_CLEARANCE_MAX) &&
        lh_within(config->tilt, LH_TILT_LIMIT_MIN, LH_TILT_LIMIT_MAX) &&
        lh_within(config->slack.position, 0.0f, LH_JUMP_MAX) && lh_within(config->slack.attitude, 0.0f, LH_JUMP_MAX) &&
        lh_within(config->slack.joint, 0.0f, LH_JUMP_MAX);
    return good ? LH_OK : LH_ERROR_MONITOR;
}

void lh_monitor_init(lh_monitor *monitor, const lh_monitor_config *config) {
    memset(monitor, 0, sizeof *monitor);
    monitor->config = *config;
}

void lh_monitor_begin(lh_monitor *monitor) {
    lh_plausibility_begin(&monitor->plausibility);
    lh_stuck_begin(&monitor->stuck);
    monitor->moving = false;
    memset(monitor->executed, 0, sizeof monitor->executed);
}

void lh_monitor_gap(lh_monitor *monitor) {
    monitor->moving = false;
}

/* Joints that were told to move from `before`: whether they did. */
static void watch_joints(lh_monitor *monitor, const lh_robot *robot, const lh_place *before, const lh_state *state) {
    for (int32_t k = 0; k < robot->num_actuators; k++) {
        if (robot->actuators[k].kind == LH_JOINT) {
            float gone = state->actuator_position[k] - before->joint[k];
            lh_stuck_watch(&monitor->stuck, k, monitor->executed[k] * monitor->config.period, gone);
        }
    }
}

/* The fastest way that each takes in a decision, and the slack. */
static lh_jump_limits jump_limits(const lh_monitor_config *config) {
    float joint = config->joint.speed * config->period;
    return (lh_jump_limits){
        .position = config->crawler.speed * config->period + config->slack.position,
        .attitude = joint + config->slack.attitude,
        .joint = joint + config->slack.joint,
    };
}

bool lh_monitor_believes(lh_monitor *monitor, const lh_robot *robot, const lh_state *state) {
    lh_place before = monitor->plausibility.believed;
    lh_jump_limits limits = jump_limits(&monitor->config);
    bool believed = lh_plausibility_check(&monitor->plausibility, robot, &limits, state);
    if (believed && monitor->moving) {
        watch_joints(monitor, robot, &before, state);
    }
    return believed;
}

static void count(lh_monitor *monitor, const lh_intervention *intervention) {
    lh_monitor_counts *counts = &monitor->counts;
    counts->decisions += intervention->hazards != 0;
    for (int32_t i = 0; i < LH_HAZARDS; i++) {
        counts->hazards[i] += intervention->hazards >> i & 1u;
    }
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        counts->actuators += intervention->stilled >> k & 1u;
    }
}

void lh_monitor_hold(lh_monitor *monitor, const lh_task *task, lh_hazard hazard, lh_intervention *intervention,
                     float *velocity) {
    *intervention = (lh_intervention){
        .action = lh_action_count(task->controlled.count) / 2, /* all digits 1 */
        .hazards = (uint32_t)hazard,
    };
    for (int32_t k = 0; k < task->controlled.count; k++) {
        intervention->stilled |= (uint32_t)1 << task->controlled.index[k];
    }
    memset(velocity, 0, sizeof(float) * LH_MAX_ACTUATORS);
    memset(monitor->executed, 0, sizeof monitor->executed);
    monitor->moving = false;
    count(monitor, intervention);
}

/* What is known of actuator k, of which `level` is proposed. */
static lh_guarded describe(const lh_monitor *monitor, const lh_task *task, const lh_state *state, int32_t k,
                           int8_t level, float velocity) {
    const lh_actuator *actuator = &task->robot.actuators[k];
    const lh_monitor_config *config = &monitor->config;
    bool is_joint = actuator->kind == LH_JOINT;
    const lh_motion_limit *limit = is_joint ? &config->joint : &config->crawler;
    return (lh_guarded){
        .level = level,
        .is_joint = is_joint,
        .failed = state->actuator_failed[k] != 0,
        .stuck = lh_stuck_is(&monitor->stuck, k),
        .velocity = velocity,
        .change = velocity - monitor->executed[k],
        .speed_limit = limit->speed,
        .change_limit = limit->acceleration * config->period,
        .angle = state->actuator_position[k],
        .ahead = state->actuator_position[k] + velocity * config->period,
        .low = actuator->low + config->stop_clearance,
        .high = actuator->high - config->stop_clearance,
    };
}

/* Where the joints are after so many seconds [s]. */
static void look_ahead(const lh_task *task, const lh_state *state, const lh_verdict *verdict, float seconds,
                       float *next) {
    for (int32_t k = 0; k < task->robot.num_actuators; k++) {
        next[k] = state->actuator_position[k] + verdict->velocity[k] * seconds;
    }
}

/* Stills the joints that would bring parts of the robot together. What is left may do so with others: this ends, as
 * each round stills one more at least. */
static void keep_apart(const lh_monitor *monitor, const lh_task *task, const lh_state *state, uint32_t whole,
                       lh_guarded *guarded, lh_verdict *verdict) {
    uint32_t stilled = 0;
    for (;;) {
        float next[LH_MAX_ACTUATORS];
        look_ahead(task, state, verdict, monitor->config.period + COASTING, next);
        uint32_t joints = lh_collision_joints(&task->robot, &monitor->shapes, monitor->config.collision_clearance,
                                              state->actuator_position, next);
        if (joints == 0) {
            return;
        }
        stilled |= joints;
        for (int32_t k = 0; k < task->robot.num_actuators; k++) {
            guarded[k].collides = (stilled >> k & 1u) != 0;
        }
        lh_interlock(guarded, task->robot.num_actuators, whole, false, verdict);
    }
}

/* Whether the joints, moved as in `verdict`, leave a margin that is below its floor and below what it is without. */
static bool lowers_margin(const lh_monitor *monitor, const lh_task *task, const lh_state *state, lh_quat attitude,
                          const lh_verdict *verdict) {
    float next[LH_MAX_ACTUATORS];
    bool moves = false;
    look_ahead(task, state, verdict, monitor->config.period, next);
    for (int32_t k = 0; k < task->robot.num_actuators; k++) {
        moves = moves || (task->robot.actuators[k].kind == LH_JOINT && verdict->level[k] != LH_STILL);
    }
    if (!moves) {
        return false;
    }
    lh_forecast margin = lh_forecast_margin(&task->robot, attitude, state->actuator_position, next);
    return margin.moving < monitor->config.margin_floor && margin.moving < margin.still;
}

static void guard(const lh_monitor *monitor, const lh_task *task, const lh_state *state, int32_t action,
                  const float *velocity, lh_guarded *guarded) {
    int8_t controlled[LH_MAX_ACTUATORS];
    int8_t level[LH_MAX_ACTUATORS];
    memset(level, LH_STILL, sizeof level);
    lh_action_levels(action, task->controlled.count, controlled);
    for (int32_t k = 0; k < task->controlled.count; k++) {
        level[task->controlled.index[k]] = controlled[k];
    }
    for (int32_t k = 0; k < task->robot.num_actuators; k++) {
        guarded[k] = describe(monitor, task, state, k, level[k], velocity[k]);
    }
}

static int32_t action_of(const lh_controlled *controlled, const lh_verdict *verdict) {
    int8_t levels[LH_MAX_ACTUATORS];
    for (int32_t k = 0; k < controlled->count; k++) {
        levels[k] = verdict->level[controlled->index[k]];
    }
    return lh_action_index(levels, controlled->count);
}

void lh_monitor_check(lh_monitor *monitor, const lh_task *task, const lh_state *state, lh_quat attitude, int32_t action,
                      lh_intervention *intervention, float *velocity) {
    lh_guarded guarded[LH_MAX_ACTUATORS];
    lh_verdict verdict;
    int32_t count_of_robot = task->robot.num_actuators;
    guard(monitor, task, state, action, velocity, guarded);
    uint32_t whole = lh_quat_tilt(attitude) <= monitor->config.tilt ? 0 : (uint32_t)LH_HAZARD_TILT;
    lh_interlock(guarded, count_of_robot, whole, false, &verdict);
    keep_apart(monitor, task, state, whole, guarded, &verdict);
    if (lowers_margin(monitor, task, state, attitude, &verdict)) {
        lh_interlock(guarded, count_of_robot, whole, true, &verdict);
    }
    *intervention = (lh_intervention){
        .action = action_of(&task->controlled, &verdict),
        .hazards = verdict.hazards,
        .stilled = verdict.stilled,
    };
    memcpy(velocity, verdict.velocity, sizeof verdict.velocity);
    memcpy(monitor->executed, verdict.velocity, sizeof verdict.velocity);
    monitor->moving = true;
    count(monitor, intervention);
}
