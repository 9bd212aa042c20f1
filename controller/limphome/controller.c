#include "limphome/controller.h"

#include <string.h>

lh_config lh_config_default(void) {
    return (lh_config){
        .task = lh_task_config_default(),
        .learner = lh_learner_config_default(),
    };
}

lh_error lh_config_validate(const lh_config *config) {
    lh_error error = lh_task_config_validate(&config->task);
    return error == LH_OK ? lh_learner_config_validate(&config->learner) : error;
}

lh_error lh_controller_init(lh_controller *controller, const lh_config *config, const lh_robot *robot,
                            const lh_controlled *controlled) {
    lh_error error = lh_config_validate(config); /* so that nothing is begun that would not be finished */
    if (error == LH_OK) {
        error = lh_task_init(&controller->task, &config->task, robot, controlled);
    }
    return error == LH_OK ? lh_learner_init(&controller->learner, &config->learner, &controller->task) : error;
}

lh_error lh_controller_restore(lh_controller *controller, const lh_learned *learned, int32_t episode) {
    if (episode < 1 || episode > LH_LAST_EPISODE) {
        return LH_ERROR_EPISODE;
    }
    lh_error error = lh_learner_restore(&controller->learner, learned);
    if (error == LH_OK) {
        lh_task_begin(&controller->task, episode);
    }
    return error;
}

void lh_controller_begin(lh_controller *controller) {
    lh_task_begin(&controller->task, controller->task.episode.number);
    lh_learner_begin(&controller->learner);
}

void lh_controller_resume(lh_controller *controller, int32_t episode) {
    lh_task_resume(&controller->task, episode);
    lh_learner_begin(&controller->learner);
}

void lh_controller_gap(lh_controller *controller) {
    lh_task_gap(&controller->task);
}

lh_error lh_controller_step(lh_controller *controller, const lh_state *state, lh_decision *decision) {
    lh_error error = lh_task_observe(&controller->task, state, &decision->observed);
    if (error != LH_OK) {
        return error;
    }
    lh_learner_step(&controller->learner, &decision->observed, &decision->choice);
    memset(decision->velocity, 0, sizeof decision->velocity);
    if (decision->observed.reset) {
        lh_learner_begin(&controller->learner);
    } else {
        lh_task_velocities(&controller->task, decision->choice.action, decision->velocity);
    }
    /* Here, last, is the place of whatever may still take away from the velocities, such as a safety monitor. */
    return LH_OK;
}
