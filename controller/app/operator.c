#include "operator.h"

#include "limphome_decision_t.h"

void operator_init(operator_lease *lease, double timeout, double period) {
    *lease = (operator_lease){
        .timeout = timeout, .longest_ago = (int64_t)(timeout / period), .in_charge = LIMPHOME_DECISION_T_LEARNER};
}

static bool is_fresh(const operator_lease *o, const limphome_operate_t *message, const operator_place *place) {
    return message->session == place->session && message->seq >= 0 && message->seq <= place->seq &&
           place->seq - message->seq <= o->longest_ago;
}

static bool follows(const operator_lease *o, const limphome_operate_t *message) {
    return message->sender != o->newest.sender || message->utime > o->newest.utime;
}

operator_verdict operator_hear(operator_lease *lease, const limphome_operate_t *message, const operator_place *place,
                               double now) {
    if (message->num_actuators != place->num_actuators) {
        return place->num_actuators == 0 ? OPERATOR_STALE : OPERATOR_MALFORMED;
    }
    if (!is_fresh(lease, message, place)) {
        return OPERATOR_STALE;
    }
    if (operator_in_charge(lease, place->lockstep, now) == LIMPHOME_DECISION_T_OPERATOR &&
        message->sender != lease->newest.sender) {
        return OPERATOR_DENIED;
    }
    if (!follows(lease, message)) {
        return OPERATOR_REPEATED;
    }
    lease->newest = *message;
    lease->heard = now;
    lease->in_charge =
        message->action == LIMPHOME_OPERATE_T_TAKE ? LIMPHOME_DECISION_T_OPERATOR : LIMPHOME_DECISION_T_LEARNER;
    return OPERATOR_OBEYED;
}

int8_t operator_in_charge(operator_lease *lease, bool lockstep, double now) {
    if (lease->in_charge == LIMPHOME_DECISION_T_OPERATOR && now - lease->heard > lease->timeout) {
        lease->in_charge = lockstep ? LIMPHOME_DECISION_T_LEARNER : LIMPHOME_DECISION_T_NOBODY;
    }
    return lease->in_charge;
}

const int8_t *operator_directions(const operator_lease *lease) {
    static const int8_t still[sizeof lease->newest.direction];
    return lease->in_charge == LIMPHOME_DECISION_T_OPERATOR ? lease->newest.direction : still;
}

int64_t operator_sender(const operator_lease *lease) {
    return lease->in_charge == LIMPHOME_DECISION_T_OPERATOR ? lease->newest.sender : 0;
}
