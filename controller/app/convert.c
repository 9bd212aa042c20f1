#include "convert.h"

#include <string.h>

#include "limphome/task/action.h"

static lh_path_kind convert_path_kind(int64_t kind) {
    switch (kind) {
        case SETTINGS_AHEAD:
            return LH_PATH_AHEAD;
        case SETTINGS_WAYPOINTS:
            return LH_PATH_WAYPOINTS;
        default:
            return LH_PATH_ROLLING;
    }
}

static lh_path_config convert_path(const settings_path *path) {
    lh_path_config config = {.kind = convert_path_kind(path->kind), .num_waypoints = (int32_t)path->count};
    for (int i = 0; i < LH_MAX_WAYPOINTS && i < SETTINGS_MAX_WAYPOINTS; i++) {
        config.waypoint[i] = (lh_point2){(float)path->x[i], (float)path->y[i]};
    }
    return config;
}

static lh_task_config convert_task(const settings *s) {
    return (lh_task_config){
        .crawler_speed = (float)s->action.crawler_speed,
        .joint_speed = (float)s->action.joint_speed,
        .reward =
            {
                .forward = (float)s->reward.forward,
                .sideways = (float)s->reward.sideways,
                .turn = (float)s->reward.turn,
                .heading_error = s->reward.turn_of == SETTINGS_TURN_ERROR,
                .goal = (float)s->reward.goal,
                .stability = (float)s->reward.stability,
                .tumble = (float)s->reward.tumble,
            },
        .episode =
            {
                .goal_distance = (float)s->episode.goal_distance_m,
                .step_limit = (int32_t)s->episode.step_limit,
                .tumble_tilt = (float)s->episode.tumble_tilt_rad,
                .reset_every = (int32_t)s->episode.reset_every,
            },
        .path = convert_path(&s->task.path),
    };
}

static lh_q_learning_config convert_q_learning(const settings *s) {
    return (lh_q_learning_config){
        .learning_rate = (float)s->learning.learning_rate,
        .discount_rate = (float)s->learning.discount_rate,
        .temperature_floor = (float)s->exploration.temperature_floor,
        .network =
            {
                .units = (int32_t)s->rbf.units,
                .inputs = lh_network_config_default().inputs, /* until the task is known */
                .rate_weight = (float)s->rbf.rate_weight,
                .rate_width = (float)s->rbf.rate_width,
                .rate_centre = (float)s->rbf.rate_centre,
                .initial_weight = (float)s->rbf.initial_weight,
                .initial_width = (float)s->rbf.initial_width,
                .width_floor = (float)s->rbf.width_floor,
                .weight_limit = (float)s->rbf.weight_limit,
                .exact_gradient = s->rbf.gradient == SETTINGS_GRADIENT_EXACT,
            },
    };
}

static lh_planner_config convert_planner(const settings *s) {
    return (lh_planner_config){
        .decision_period = (float)s->episode.decision_period_s,
        .discount_rate = (float)s->learning.discount_rate,
        .mechanics = s->planner.mechanics == SETTINGS_MECHANICS_QUASI_STATIC,
        .steering = (float)s->planner.steering,
        .unsafe = (float)s->planner.unsafe,
        .caution = (float)s->planner.caution,
        .random_share = (float)s->planner.random_share,
        .candidates = (int32_t)s->planner.candidates,
        .sweeps = (int32_t)s->planner.sweeps,
        .backups = (int32_t)s->planner.backups,
    };
}

static lh_monitor_config convert_monitor(const settings *s) {
    lh_monitor_config config = lh_monitor_config_default();
    config.active = s->safety.monitor == SETTINGS_MONITOR_ON;
    config.period = (float)s->episode.decision_period_s;
    config.crawler.speed = (float)s->safety.crawler_speed;
    config.crawler.acceleration = (float)s->safety.crawler_acceleration;
    config.joint.speed = (float)s->safety.joint_speed;
    config.joint.acceleration = (float)s->safety.joint_acceleration;
    config.stop_clearance = (float)s->safety.stop_clearance_rad;
    config.margin_floor = (float)s->safety.margin_floor_m;
    config.collision_clearance = (float)s->safety.collision_clearance_m;
    config.tilt = (float)s->safety.tilt_rad;
    return config;
}

static lh_learner_kind convert_learner_kind(int64_t kind) {
    switch ((enum settings_learner)kind) {
        case SETTINGS_Q_LEARNING:
            return LH_Q_LEARNING;
        case SETTINGS_PLANNER:
            return LH_PLANNER;
    }
    return LH_Q_LEARNING;
}

lh_config convert_config(const settings *s) {
    lh_config config = lh_config_default();
    config.task = convert_task(s);
    config.learner.kind = convert_learner_kind(s->learner.kind);
    config.learner.seed = (uint64_t)s->learning.seed;
    config.learner.q_learning = convert_q_learning(s);
    config.learner.planner = convert_planner(s);
    config.monitor = convert_monitor(s);
    return config;
}

lh_state convert_state(const limphome_robot_state_t *message) {
    lh_state state;
    memset(&state, 0, sizeof state);
    for (int i = 0; i < 3; i++) {
        state.position[i] = (float)message->position[i];
    }
    state.orientation = (lh_quat){(float)message->orientation[0], (float)message->orientation[1],
                                  (float)message->orientation[2], (float)message->orientation[3]};
    state.num_actuators = message->num_actuators;
    for (int i = 0; i < message->num_actuators && i < LH_MAX_ACTUATORS; i++) {
        state.actuator_position[i] = (float)message->actuator_position[i];
        state.actuator_effort[i] = (float)message->actuator_effort[i];
        state.actuator_failed[i] = (int8_t)(message->actuator_health[i] == LIMPHOME_ROBOT_STATE_T_FAILED);
    }
    return state;
}

lh_controlled convert_controlled(const limphome_robot_state_t *message) {
    lh_controlled controlled = {.count = 0};
    for (int32_t i = 0; i < message->num_actuators && i < LH_MAX_ACTUATORS; i++) {
        if (message->actuator_health[i] != LIMPHOME_ROBOT_STATE_T_FAILED) {
            controlled.index[controlled.count++] = i;
        }
    }
    return controlled;
}

/* The bits of a hazard are told as they are. */
#define SAME_HAZARD(name) _Static_assert(LH_HAZARD_##name == LIMPHOME_DECISION_T_##name, "decision_t." #name)
SAME_HAZARD(INVALID);
SAME_HAZARD(STALE);
SAME_HAZARD(JUMP);
SAME_HAZARD(TILT);
SAME_HAZARD(MARGIN);
SAME_HAZARD(SPEED);
SAME_HAZARD(ACCELERATION);
SAME_HAZARD(STOP);
SAME_HAZARD(FAILED);
SAME_HAZARD(STUCK);
SAME_HAZARD(COLLISION);

/* So that a new one is told here and in convert_episode. */
_Static_assert(sizeof(lh_reward) == 4 * sizeof(float), "decision_t and episode_t tell four terms of the reward");

limphome_decision_t convert_decision(const lh_controller *c, const lh_decision *d,
                                     const limphome_robot_state_t *state) {
    const lh_observed *seen = &d->observed;
    limphome_decision_t message = {
        .utime = state->utime,
        .session = state->session,
        .seq = state->seq,
        .episode = seen->episode,
        .step = seen->step,
        .num_inputs = seen->num_inputs,
        .action = d->intervention.action,
        .proposed_action = d->choice.action,
        .interventions = (int32_t)d->intervention.hazards,
        .stilled = (int32_t)d->intervention.stilled,
        .q = d->choice.q,
        .q_max = d->choice.q_max,
        .probability = d->choice.probability,
        .temperature = d->choice.temperature,
        .learned = d->choice.learned,
        .td_error = d->choice.td_error,
        .reward_motion = seen->reward.motion,
        .reward_goal = seen->reward.goal,
        .reward_stability = seen->reward.stability,
        .reward_tumble = seen->reward.tumble,
        .stability_margin = seen->stability_margin,
        .goal_distance = seen->goal_distance,
        .lateral_error = seen->lateral_error,
        .heading_error = seen->heading_error,
        .waypoint_distance = seen->waypoint_distance,
    };
    memcpy(message.inputs, seen->inputs, sizeof seen->inputs);
    if (!seen->reset) {
        lh_action_inputs(d->intervention.action, c->task.controlled.count, message.inputs + seen->num_inputs);
        message.num_inputs += c->task.controlled.count;
    }
    return message;
}

static int8_t convert_outcome(lh_outcome outcome) {
    switch (outcome) {
        case LH_OUTCOME_GOAL:
            return LIMPHOME_EPISODE_T_GOAL;
        case LH_OUTCOME_TUMBLE:
            return LIMPHOME_EPISODE_T_TUMBLE;
        case LH_OUTCOME_TIMEOUT:
            return LIMPHOME_EPISODE_T_TIMEOUT;
        case LH_OUTCOME_NONE: /* an episode that goes on has no summary */
            break;
    }
    return -1;
}

limphome_episode_t convert_episode(const lh_controller *c, const lh_summary *s, const limphome_robot_state_t *state,
                                   double decision_period) {
    return (limphome_episode_t){
        .utime = state->utime,
        .session = state->session,
        .episode = s->number,
        .outcome = convert_outcome(s->outcome),
        .steps = s->steps,
        .duration = s->steps * decision_period,
        .reward = (double)lh_reward_total(&s->total),
        .reward_motion = (double)s->total.motion,
        .reward_goal = (double)s->total.goal,
        .reward_stability = (double)s->total.stability,
        .reward_tumble = (double)s->total.tumble,
        .lateral_error = (double)s->lateral_error,
        .heading_change = (double)s->heading_change,
        .temperature = (double)lh_learner_temperature(&c->learner, s->number),
        .start = {(double)s->start.x, (double)s->start.y},
        .start_heading = (double)s->start.heading,
        .line_heading = (double)s->line_heading,
        .start_lateral_error = (double)s->start_lateral_error,
        .goal_distance = (double)s->goal_distance,
        .waypoint_distance = (double)s->waypoint_distance,
        .arrived = s->arrived,
    };
}

void convert_limits(const lh_controller *c, limphome_status_t *status) {
    status->clamped_inputs = (int64_t)c->task.clamped.inputs;
    status->clamped_margins = (int64_t)c->task.clamped.margins;
    status->interventions = (int64_t)c->monitor.counts.decisions;
    status->stilled_actuators = (int64_t)c->monitor.counts.actuators;
    switch (c->learner.kind) {
        case LH_Q_LEARNING: {
            const lh_q_learning *learner = &c->learner.as.q_learning;
            status->clamped_temperatures = (int64_t)learner->floored;
            status->clamped_weights = (int64_t)learner->held.weights;
            status->clamped_widths = (int64_t)learner->held.widths;
            status->clamped_centres = (int64_t)learner->held.centres;
            break;
        }
        case LH_PLANNER:
            break;
    }
    status->clamped = status->clamped_inputs + status->clamped_temperatures + status->clamped_margins +
                      status->clamped_weights + status->clamped_widths + status->clamped_centres;
}
