#include "limphome/controller.h"

#include <string.h>

#include "limphome/task/action.h"

lh_config lh_config_default(void) {
    return (lh_config){
        .task = lh_task_config_default(),
        .learner = lh_learner_config_default(),
        .monitor = lh_monitor_config_default(),
    };
}

lh_error lh_config_validate(const lh_config *config) {
    lh_error error = lh_task_config_validate(&config->task);
    if (error == LH_OK) {
        error = lh_learner_config_validate(&config->learner);
    }
    return error == LH_OK ? lh_monitor_config_validate(&config->monitor) : error;
}

lh_error lh_controller_init(lh_controller *controller, const lh_config *config, const lh_robot *robot,
                            const lh_controlled *controlled) {
    lh_error error = lh_config_validate(config); /* so that nothing is begun that would not be finished */
    if (error == LH_OK) {
        error = lh_task_init(&controller->task, &config->task, robot, controlled);
    }
    if (error == LH_OK) {
        error = lh_learner_init(&controller->learner, &config->learner, &controller->task);
    }
    if (error == LH_OK) {
        lh_monitor_init(&controller->monitor, &config->monitor);
        if (config->monitor.active) {
            lh_controller_guard(controller);
        }
    }
    return error;
}

lh_error lh_controller_keep_apart(lh_controller *controller, const lh_shapes *shapes) {
    lh_error error = lh_shapes_validate(shapes, &controller->task.robot);
    if (error == LH_OK) {
        controller->monitor.shapes = *shapes;
    }
    return error;
}

lh_error lh_controller_restore(lh_controller *controller, const lh_learned *learned, int32_t episode) {
    if (episode < 1 || episode > LH_LAST_EPISODE) {
        return LH_ERROR_EPISODE;
    }
    lh_error error = lh_learner_restore(&controller->learner, learned);
    if (error == LH_OK) {
        lh_task_begin(&controller->task, episode);
        lh_monitor_begin(&controller->monitor);
    }
    return error;
}

void lh_controller_begin(lh_controller *controller) {
    lh_task_begin(&controller->task, controller->task.episode.number);
    lh_learner_begin(&controller->learner);
    lh_monitor_begin(&controller->monitor);
}

void lh_controller_resume(lh_controller *controller, int32_t episode) {
    lh_task_resume(&controller->task, episode);
    lh_learner_begin(&controller->learner);
    lh_monitor_begin(&controller->monitor);
}

void lh_controller_gap(lh_controller *controller) {
    lh_task_gap(&controller->task);
    lh_monitor_gap(&controller->monitor);
}

void lh_controller_guard(lh_controller *controller) {
    lh_monitor_config *config = &controller->monitor.config;
    config->active = true;
    lh_learner_keep_clear(&controller->learner,
                          controller->task.config.joint_speed * config->period + config->stop_clearance);
}

/* Nothing is taken from the state. */
static void hold(lh_controller *controller, lh_hazard hazard, lh_decision *decision) {
    const lh_task *task = &controller->task;
    memset(decision, 0, sizeof *decision);
    decision->observed.episode = task->episode.number;
    decision->observed.step = task->episode.steps;
    decision->observed.num_inputs = task->controlled.count + 2;
    lh_monitor_hold(&controller->monitor, task, hazard, &decision->intervention, decision->velocity);
    decision->choice.action = decision->intervention.action;
    lh_controller_gap(controller);
}

void lh_controller_hold(lh_controller *controller, lh_decision *decision) {
    hold(controller, LH_HAZARD_STALE, decision);
}

/* The last word: what is chosen, or what the monitor leaves of it. */
static void execute(lh_controller *controller, const lh_state *state, lh_decision *decision) {
    int32_t chosen = decision->choice.action;
    decision->intervention.action = chosen;
    lh_task_velocities(&controller->task, chosen, decision->velocity);
    if (controller->monitor.config.active) {
        lh_monitor_check(&controller->monitor, &controller->task, state, decision->observed.attitude, chosen,
                         &decision->intervention, decision->velocity);
        if (decision->intervention.action != chosen) {
            lh_learner_executed(&controller->learner, decision->intervention.action);
        }
    }
}

/* Whether there is something to decide on. If not, the robot is held, and the error tells whether the state is to
 * blame. */
static bool observe(lh_controller *controller, const lh_state *state, lh_decision *decision, lh_error *error) {
    lh_monitor *monitor = &controller->monitor;
    const lh_robot *robot = &controller->task.robot;
    *error = lh_state_validate(state, robot);
    if (*error == LH_OK && monitor->config.active && !lh_monitor_believes(monitor, robot, state)) {
        hold(controller, LH_HAZARD_JUMP, decision);
        return false;
    }
    if (*error == LH_OK) {
        *error = lh_task_observe(&controller->task, state, &decision->observed);
    }
    if (*error != LH_OK) {
        hold(controller, LH_HAZARD_INVALID, decision);
        return false;
    }
    memset(&decision->intervention, 0, sizeof decision->intervention);
    memset(decision->velocity, 0, sizeof decision->velocity);
    return true;
}

lh_error lh_controller_step(lh_controller *controller, const lh_state *state, lh_decision *decision) {
    lh_error error;
    if (!observe(controller, state, decision, &error)) {
        return error;
    }
    lh_learner_step(&controller->learner, &decision->observed, &decision->choice);
    if (decision->observed.reset) {
        lh_learner_begin(&controller->learner);
        lh_monitor_begin(&controller->monitor);
    } else {
        execute(controller, state, decision);
    }
    return LH_OK;
}

static int32_t action_of(const lh_controlled *controlled, const int8_t *direction) {
    int8_t levels[LH_MAX_ACTUATORS];
    for (int32_t k = 0; k < controlled->count; k++) {
        int8_t wanted = direction[controlled->index[k]];
        levels[k] = (int8_t)(wanted == 1 || wanted == -1 ? LH_STILL + wanted : LH_STILL);
    }
    return lh_action_index(levels, controlled->count);
}

/* An episode that begins where the robot is begins anew at each state, so that none is ever under way. */
lh_error lh_controller_drive(lh_controller *controller, const lh_state *state, const int8_t *direction,
                             lh_decision *decision) {
    lh_task *task = &controller->task;
    lh_error error;
    lh_task_resume(task, task->episode.number);
    lh_learner_begin(&controller->learner);
    if (!observe(controller, state, decision, &error)) {
        return error;
    }
    lh_observed *observed = &decision->observed;
    decision->choice = (lh_choice){.action = action_of(&task->controlled, direction)};
    observed->reset = lh_quat_tilt(observed->attitude) > task->config.episode.tumble_tilt;
    if (observed->reset) {
        lh_controller_begin(controller);
    } else {
        lh_task_resume(task, task->episode.number);
        lh_task_velocities(task, decision->choice.action, decision->velocity);
        lh_monitor_check(&controller->monitor, task, state, observed->attitude, decision->choice.action,
                         &decision->intervention, decision->velocity);
    }
    return LH_OK;
}
