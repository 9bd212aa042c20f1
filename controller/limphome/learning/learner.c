#include "limphome/learning/learner.h"

#include <stddef.h>
#include <string.h>

lh_learner_config lh_learner_config_default(void) {
    return (lh_learner_config){
        .kind = LH_Q_LEARNING,
        .seed = 1,
        .learn = true,
        .greedy = false,
        .q_learning = lh_q_learning_config_default(),
        .planner = lh_planner_config_default(),
    };
}

lh_error lh_learner_config_validate(const lh_learner_config *config) {
    switch (config->kind) {
        case LH_Q_LEARNING:
            return lh_q_learning_config_validate(&config->q_learning);
        case LH_PLANNER:
            return lh_planner_config_validate(&config->planner);
    }
    return LH_ERROR_LEARNER;
}

/* Inputs of the network follow from the task. */
static lh_error init_q_learning(lh_learner *learner, const lh_learner_config *config, const lh_task *task) {
    int32_t num_controlled = task->controlled.count;
    lh_q_learning_config complete = config->q_learning;
    complete.network.inputs = num_controlled + 2 + num_controlled;
    return lh_q_learning_init(&learner->as.q_learning, &complete, num_controlled + 2, num_controlled, config->seed);
}

lh_error lh_learner_init(lh_learner *learner, const lh_learner_config *config, const lh_task *task) {
    lh_error error = LH_ERROR_LEARNER;
    switch (config->kind) {
        case LH_Q_LEARNING:
            error = init_q_learning(learner, config, task);
            break;
        case LH_PLANNER:
            error = lh_planner_init(&learner->as.planner, &config->planner, task, config->seed);
            break;
    }
    if (error == LH_OK) {
        memset(learner, 0, offsetof(lh_learner, as)); /* what lies between the fields, too */
        learner->kind = config->kind;
        learner->learn = config->learn;
        learner->greedy = config->greedy;
    }
    return error;
}

void lh_learner_begin(lh_learner *learner) {
    switch (learner->kind) {
        case LH_Q_LEARNING:
            lh_q_learning_begin(&learner->as.q_learning);
            break;
        case LH_PLANNER:
            lh_planner_begin(&learner->as.planner);
            break;
    }
}

void lh_learner_step(lh_learner *learner, const lh_observed *observed, lh_choice *choice) {
    switch (learner->kind) {
        case LH_Q_LEARNING:
            lh_q_learning_step(&learner->as.q_learning, observed, learner->learn, learner->greedy, choice);
            break;
        case LH_PLANNER:
            lh_planner_step(&learner->as.planner, observed, learner->learn, learner->greedy, choice);
            break;
    }
}

void lh_learner_keep_clear(lh_learner *learner, float clearance) {
    if (learner->kind == LH_PLANNER) {
        lh_planner_keep_clear(&learner->as.planner, clearance);
    }
}

void lh_learner_executed(lh_learner *learner, int32_t action) {
    switch (learner->kind) {
        case LH_Q_LEARNING:
            lh_q_learning_executed(&learner->as.q_learning, action);
            break;
        case LH_PLANNER:
            lh_planner_executed(&learner->as.planner, action);
            break;
    }
}

float lh_learner_temperature(const lh_learner *learner, int32_t episode) {
    switch (learner->kind) {
        case LH_Q_LEARNING:
            return lh_q_learning_temperature(&learner->as.q_learning, episode);
        case LH_PLANNER:
            return 0.0f;
    }
    return 0.0f;
}

void lh_learner_save(const lh_learner *learner, lh_learned *learned) {
    learned->kind = learner->kind;
    switch (learner->kind) {
        case LH_Q_LEARNING:
            lh_q_learning_save(&learner->as.q_learning, &learned->as.q_learning);
            break;
        case LH_PLANNER:
            lh_planner_save(&learner->as.planner, &learned->as.planner);
            break;
    }
}

lh_error lh_learner_restore(lh_learner *learner, const lh_learned *learned) {
    if (learned->kind != learner->kind) {
        return LH_ERROR_LEARNER;
    }
    switch (learner->kind) {
        case LH_Q_LEARNING:
            return lh_q_learning_restore(&learner->as.q_learning, &learned->as.q_learning);
        case LH_PLANNER:
            return lh_planner_restore(&learner->as.planner, &learned->as.planner);
    }
    return LH_ERROR_LEARNER;
}
