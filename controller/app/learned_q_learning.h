/* What Q-learning has learned, between the library and its messages. */
#ifndef LIMPHOME_APP_LEARNED_Q_LEARNING_H
#define LIMPHOME_APP_LEARNED_Q_LEARNING_H

#include <stdbool.h>

#include "limphome/controller.h"
#include "limphome_policy_t.h"
#include "limphome_q_learning_t.h"

/* Fills in the network, for what it is, and what else is needed to go on learning, of messages that are 0. */
void learned_save_q_learning(limphome_policy_t *policy, limphome_q_learning_t *rest, const lh_controller *controller);

/* `rest` NULL: that of *restored stays. False if the policy is for other actuators, speeds or ranges of inputs than the
 * controller's. */
bool learned_restore_q_learning(const limphome_policy_t *policy, const limphome_q_learning_t *rest,
                                const lh_controller *controller, lh_q_learned *restored);

#endif
