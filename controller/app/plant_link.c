#include "plant_link.h"

#include <string.h>

static const double denied_interval = 0.25; /* between requests to a plant that obeys another [s] */

/* Keeps a state to decide upon. In real time an older one that has not been decided upon is overtaken. */
static void keep(plant_link *l, const limphome_robot_state_t *state) {
    l->bus.counts.duplicates += l->fresh;
    l->newest = *state;
    l->fresh = true;
    l->unanswered = false;
}

/* Whether a state is young enough to be acted on; in lockstep it always is, the plant waits. */
static bool is_fresh(plant_link *l, const limphome_robot_state_t *state, double now) {
    const double sent = (double)state->sent * 1e-6;
    if (state->lockstep != 0) {
        return true;
    }
    if (l->begins) {
        age_begin(&l->age, l->session.asked, sent, now);
        return true;
    }
    switch (age_judge(&l->age, sent, now, l->command_timeout)) {
        case AGE_FRESH:
            return true;
        case AGE_STALE:
            l->bus.counts.stale++;
            break;
        case AGE_IMPOSSIBLE:
            l->bus.counts.rejected_ahead++;
            break;
    }
    l->invalid = now;
    return false;
}

static void on_new(plant_link *l, const limphome_robot_state_t *state, bool was_asking, double now) {
    if (was_asking) {
        l->begins = true;
        l->asks = false;
    }
    if (is_fresh(l, state, now)) {
        keep(l, state);
    }
}

/* A repetition of what was not decided upon asks for nothing. */
static void on_repeated(plant_link *l, const limphome_robot_state_t *state) {
    l->bus.counts.duplicates++;
    l->unanswered =
        l->unanswered || (!l->fresh && l->command.session == state->session && l->command.seq == state->seq);
}

static void on_state(void *user, const limphome_robot_state_t *state) {
    plant_link *l = user;
    const double now = bus_now();
    const bool was_asking = l->session.asking;
    const session_label label = {state->session, state->seq, state->reset_sender, state->reset_nonce,
                                 state->lockstep != 0};
    l->heard = now;
    l->denied = session_is_anothers(&l->session, &label) ? now : l->denied;
    switch (session_judge(&l->session, &label, now)) {
        case SESSION_NEW:
            on_new(l, state, was_asking, now);
            break;
        case SESSION_REPEATED:
            on_repeated(l, state);
            break;
        case SESSION_RESET:
            l->asks = true;
            break;
        case SESSION_DENIED:
            l->asks = l->asks || now >= l->denied_due;
            break;
        case SESSION_AHEAD:
            l->bus.counts.rejected_ahead++;
            break;
        case SESSION_OTHER:
        case SESSION_OLD:
        default:
            l->bus.counts.rejected_session++;
            break;
    }
}

/* What the plant tells beside its states: that a session has ended without our asking, that a person holds it up. */
static void on_status(void *user, const limphome_status_t *status) {
    plant_link *l = user;
    if (status->condition == LIMPHOME_STATUS_T_FAULT) {
        session_over(&l->session, status->session, SESSION_FAULTED);
    } else if (status->reason == LIMPHOME_STATUS_T_BEGUN_ANEW) {
        session_over(&l->session, status->session, SESSION_ENDED);
    } else if (status->reason == LIMPHOME_STATUS_T_PACED && status->session == l->session.session) {
        l->paced = bus_now();
    }
}

static void count_operate(limphome_status_t *counts, operator_verdict verdict) {
    switch (verdict) {
        case OPERATOR_OBEYED:
            counts->operated++;
            break;
        case OPERATOR_MALFORMED:
            counts->operate_malformed++;
            break;
        case OPERATOR_STALE:
            counts->operate_stale++;
            break;
        case OPERATOR_DENIED:
            counts->operate_denied++;
            break;
        case OPERATOR_REPEATED:
            counts->operate_repeated++;
            break;
    }
}

static bool on_operate(void *user, const limphome_operate_t *message) {
    plant_link *l = user;
    const bool ours = !l->session.asking && l->newest.session == l->session.session;
    const operator_place place = {.session = l->session.session,
                                  .seq = l->session.seq,
                                  .num_actuators = ours ? l->newest.num_actuators : 0,
                                  .lockstep = l->newest.lockstep != 0};
    const operator_verdict verdict = operator_hear(&l->hand, message, &place, bus_now());
    count_operate(&l->bus.counts, verdict);
    return verdict == OPERATOR_OBEYED;
}

bool plant_link_open(plant_link *l, const char *url, const settings *s, recording *log, char error[ERROR_LENGTH]) {
    memset(l, 0, sizeof *l);
    const bus_listener listener = {.state = on_state, .status = on_status, .operate = on_operate, .user = l};
    int64_t seed;
    if (!bus_draw(&seed, error) || !bus_open(&l->bus, url, listener, log, error)) {
        return false;
    }
    l->command_timeout = s->link.command_timeout_s;
    session_init(&l->session, l->bus.sender, (uint64_t)seed, s->link.sender_timeout_s, s->episode.decision_period_s);
    operator_init(&l->hand, s->link.operator_timeout_s, s->episode.decision_period_s);
    return true;
}

/* Repetitions of a request are those with its nonce. */
static void send_reset(plant_link *l, int32_t episode) {
    const limphome_reset_request_t request = {.utime = bus_now_us(),
                                              .session = l->session.session,
                                              .seq = l->session.seq,
                                              .sender = l->bus.sender,
                                              .nonce = l->session.nonce,
                                              .episode = episode};
    bus_send_reset(&l->bus, &request, l->requested == request.nonce);
    l->requested = request.nonce;
    l->denied_due = bus_now() + denied_interval;
    l->asks = false;
}

static int64_t refused_states(const plant_link *l) {
    return l->bus.counts.rejected_malformed + l->bus.counts.rejected_non_finite;
}

bool plant_link_wait(plant_link *l, double timeout) {
    const int64_t refused = refused_states(l);
    if (!bus_wait(&l->bus, timeout)) {
        return false;
    }
    if (refused_states(l) > refused) {
        l->invalid = bus_now();
    }
    return true;
}

void plant_link_answer(plant_link *l, int32_t episode) {
    if (l->asks) {
        send_reset(l, episode);
    }
    if (l->unanswered) {
        bus_send_command(&l->bus, &l->command, true);
        l->unanswered = false;
    }
}

bool plant_link_take(plant_link *l, plant_state *taken) {
    if (!l->fresh) {
        return false;
    }
    const bool follows = l->newest.seq == l->decided + 1 && l->newest.held == 0;
    *taken = (plant_state){.state = l->newest, .begins = l->begins, .gap = !l->begins && !follows};
    recording_at(l->bus.recording, l->newest.utime);
    l->decided = l->newest.seq;
    l->fresh = l->begins = false;
    return true;
}

void plant_link_command(plant_link *l, const limphome_robot_state_t *state, const float *velocity) {
    l->command = (limphome_velocity_command_t){.utime = bus_now_us(),
                                               .session = state->session,
                                               .seq = state->seq,
                                               .sender = l->bus.sender,
                                               .num_actuators = state->num_actuators};
    for (int i = 0; i < state->num_actuators; i++) {
        l->command.velocity[i] = (double)velocity[i];
    }
    bus_send_command(&l->bus, &l->command, false);
}

void plant_link_reset(plant_link *l, int32_t episode) {
    session_reset(&l->session, bus_now());
    send_reset(l, episode);
}

session_break plant_link_broken(plant_link *l) {
    const session_break broken = l->session.broken;
    l->session.broken = SESSION_UNBROKEN;
    if (broken != SESSION_UNBROKEN) { /* a state heard just before is of the session that is over */
        l->fresh = l->begins = l->unanswered = false;
    }
    return broken;
}
