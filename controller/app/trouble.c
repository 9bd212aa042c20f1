#include "trouble.h"

#include <math.h>

static const double usual_pause = 1; /* between two looks [s]; a decision takes milliseconds */
static const double paced_lasts = 3; /* a plant that is held up says so each second [s] */

static const char *const words[TROUBLE_KINDS] = {
    [LIMPHOME_STATUS_T_NO_PLANT] = "no plant is heard; is one running on this network?",
    [LIMPHOME_STATUS_T_PLANT_SILENT] = "the plant has fallen silent",
    [LIMPHOME_STATUS_T_NOT_OBEYED] = "the plant does not obey us; another controller has its session",
    [LIMPHOME_STATUS_T_INVALID_STATES] = "the plant's states are invalid or too old; holding still",
    [LIMPHOME_STATUS_T_NOT_ARMED] = "the plant is not armed; holding still",
    [LIMPHOME_STATUS_T_TUMBLED] = "the robot has tumbled and cannot be carried back; holding still until it is righted",
    [LIMPHOME_STATUS_T_FLOODED] = "more messages come than can be looked at",
    [LIMPHOME_STATUS_T_PACED] = "the plant is held up by a person at a viewer",
    [LIMPHOME_STATUS_T_OPERATOR_SILENT] =
        "the operator who had the robot by hand is silent; holding still until one takes it or gives it to the learner",
};

void trouble_init(trouble *t, const settings *s, double now) {
    const double give_up = s->link.give_up_s;
    *t = (trouble){.timeout = give_up > 0 ? fmin(s->link.sender_timeout_s, give_up) : s->link.sender_timeout_s,
                   .give_up = give_up,
                   .useful = now,
                   .looked = now,
                   .flooded = now - usual_pause};
}

/* Says so when it begins. */
static void set_reason(trouble *t, int8_t reason, double now) {
    if (reason != t->reason && reason != LIMPHOME_STATUS_T_NONE) {
        notice_print(&t->notices[reason], now, "%s", words[reason]);
    }
    t->reason = reason;
}

/* Whether the plant is answered, but by rest. */
static bool rests(const trouble *t) {
    return t->reason == LIMPHOME_STATUS_T_NOT_ARMED || t->reason == LIMPHOME_STATUS_T_TUMBLED ||
           t->reason == LIMPHOME_STATUS_T_OPERATOR_SILENT;
}

void trouble_useful(trouble *t, int8_t reason, double now) {
    t->useful = now;
    if (reason != LIMPHOME_STATUS_T_NONE) {
        set_reason(t, reason, now);
    } else if (t->reason != LIMPHOME_STATUS_T_FLOODED) {
        t->reason = LIMPHOME_STATUS_T_NONE;
    }
}

/* Of what was heard, why nothing could be decided for a while. */
static int8_t cause(const trouble *t, const plant_link *l, double now) {
    const double since = now - t->timeout;
    if (l->heard == 0 && l->invalid == 0) {
        return LIMPHOME_STATUS_T_NO_PLANT;
    }
    if (l->invalid > since) {
        return LIMPHOME_STATUS_T_INVALID_STATES;
    }
    return l->denied > since ? LIMPHOME_STATUS_T_NOT_OBEYED : LIMPHOME_STATUS_T_PLANT_SILENT;
}

/* What has gathered while we were stopped is no flood: a bus holds less than that many overruns. */
static void look_for_flood(trouble *t, int64_t overruns, double now) {
    if (overruns - t->overruns >= BUS_FLOOD) {
        t->flooded = now;
    }
    if (now - t->counted >= 1) {
        t->overruns = overruns;
        t->counted = now;
    }
}

double trouble_look(trouble *t, const plant_link *l, double now) {
    const double pause = now - t->looked - usual_pause;
    t->looked = now;
    if (pause > 0) {
        t->useful += pause;
    }
    look_for_flood(t, l->bus.counts.overruns, now);
    if (l->paced > 0 && now - l->paced < paced_lasts && now - t->useful >= t->timeout) {
        t->useful = now - t->timeout;
        set_reason(t, LIMPHOME_STATUS_T_PACED, now);
    } else if (now - t->useful >= t->timeout) {
        set_reason(t, cause(t, l, now), now);
    } else if (!rests(t)) {
        set_reason(t, now - t->flooded < usual_pause ? LIMPHOME_STATUS_T_FLOODED : LIMPHOME_STATUS_T_NONE, now);
    }
    return pause > 0 ? pause : 0;
}

int8_t trouble_condition(const trouble *t, int8_t condition) {
    switch (t->reason) {
        case LIMPHOME_STATUS_T_NONE:
            return condition;
        case LIMPHOME_STATUS_T_FLOODED:
            return LIMPHOME_STATUS_T_DEGRADED;
        case LIMPHOME_STATUS_T_INVALID_STATES:
        case LIMPHOME_STATUS_T_TUMBLED:
            return LIMPHOME_STATUS_T_FAULT;
        default:
            return LIMPHOME_STATUS_T_WAITING;
    }
}

bool trouble_bears(const trouble *t, double now, char error[ERROR_LENGTH]) {
    return t->give_up <= 0 || now - t->useful < t->give_up || words[t->reason] == NULL ||
           fail_with(error, "given up after %g s: %s", t->give_up, words[t->reason]);
}
