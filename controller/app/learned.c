#include "learned.h"

#include <string.h>

#include "checksum.h"
#include "learned_planner.h"
#include "learned_q_learning.h"
#include "limphome_channels.h"

static int encode_policy(const learned *l, unsigned char *bytes, int size) {
    switch (l->kind) {
        case LH_Q_LEARNING:
            return limphome_policy_t_encode(bytes, 0, size, &l->as.q_learning.policy);
        case LH_PLANNER:
            return limphome_planner_t_encode(bytes, 0, size, &l->as.planner.planner);
    }
    return -1;
}

/* The policy within a checkpoint has the checksum that it has by itself, so that it can be taken out. */
static void seal_policy(learned *l) {
    unsigned char bytes[LEARNED_LARGEST];
    const int32_t sum = checksum_seal(bytes, encode_policy(l, bytes, sizeof bytes));
    switch (l->kind) {
        case LH_Q_LEARNING:
            l->as.q_learning.policy.crc32 = sum;
            break;
        case LH_PLANNER:
            l->as.planner.planner.crc32 = sum;
            break;
    }
}

void learned_save(learned *l, const lh_controller *c, int32_t episode, int64_t utime, int64_t settings_hash) {
    memset(l, 0, sizeof *l);
    l->kind = c->learner.kind;
    switch (l->kind) {
        case LH_Q_LEARNING:
            learned_save_q_learning(&l->as.q_learning.policy, &l->as.q_learning.q_learning, c);
            l->as.q_learning.learner = LIMPHOME_CHECKPOINT_T_Q_LEARNING;
            l->as.q_learning.settings_hash = settings_hash;
            l->as.q_learning.episode = l->as.q_learning.policy.episode = episode;
            l->as.q_learning.policy.utime = utime;
            break;
        case LH_PLANNER:
            learned_save_planner(&l->as.planner.planner, c);
            l->as.planner.settings_hash = settings_hash;
            l->as.planner.episode = l->as.planner.planner.episode = episode;
            l->as.planner.planner.utime = utime;
            break;
    }
    seal_policy(l);
}

bool learned_restore(const learned *l, const lh_controller *c, lh_learned *restored) {
    if (l->kind != c->learner.kind) {
        return false;
    }
    lh_learner_save(&c->learner, restored);
    switch (l->kind) {
        case LH_Q_LEARNING:
            return learned_restore_q_learning(&l->as.q_learning.policy,
                                              l->policy_only ? NULL : &l->as.q_learning.q_learning, c,
                                              &restored->as.q_learning);
        case LH_PLANNER:
            return learned_restore_planner(&l->as.planner.planner, c, &restored->as.planner);
    }
    return false;
}

int32_t learned_episode(const learned *l) {
    switch (l->kind) {
        case LH_Q_LEARNING:
            return l->as.q_learning.policy.episode;
        case LH_PLANNER:
            return l->as.planner.planner.episode;
    }
    return 0;
}

/* An index that is negative becomes one that lh_controller_init refuses, as others beyond the robot's. */
static lh_controlled controlled_of(int32_t count, const int8_t *index) {
    lh_controlled controlled = {.count = 0};
    while (controlled.count < count && controlled.count < LH_MAX_ACTUATORS) {
        controlled.index[controlled.count] = (uint8_t)index[controlled.count];
        controlled.count++;
    }
    return controlled;
}

lh_controlled learned_controlled(const learned *l) {
    switch (l->kind) {
        case LH_Q_LEARNING:
            return controlled_of(l->as.q_learning.policy.num_controlled, l->as.q_learning.policy.controlled);
        case LH_PLANNER:
            return controlled_of(l->as.planner.planner.num_controlled, l->as.planner.planner.controlled);
    }
    return (lh_controlled){.count = 0};
}

int64_t learned_settings_hash(const learned *l) {
    switch (l->kind) {
        case LH_Q_LEARNING:
            return l->as.q_learning.settings_hash;
        case LH_PLANNER:
            return l->as.planner.settings_hash;
    }
    return 0;
}

const char *learned_channel(const learned *l) {
    switch (l->kind) {
        case LH_Q_LEARNING:
            return LIMPHOME_CHANNEL_POLICY;
        case LH_PLANNER:
            return LIMPHOME_CHANNEL_PLANNER;
    }
    return NULL;
}

static int encode_checkpoint(const learned *l, unsigned char *bytes, int size) {
    switch (l->kind) {
        case LH_Q_LEARNING:
            return limphome_checkpoint_t_encode(bytes, 0, size, &l->as.q_learning);
        case LH_PLANNER:
            return limphome_planner_checkpoint_t_encode(bytes, 0, size, &l->as.planner);
    }
    return -1;
}

int learned_encode_policy(const learned *l, unsigned char *bytes, int size) {
    const int length = encode_policy(l, bytes, size);
    checksum_seal(bytes, length);
    return length;
}

int learned_encode_checkpoint(const learned *l, unsigned char *bytes, int size) {
    const int length = encode_checkpoint(l, bytes, size);
    checksum_seal(bytes, length);
    return length;
}

message_verdict learned_decode_policy(const void *data, size_t size, learned *l) {
    memset(l, 0, sizeof *l);
    l->policy_only = true;
    l->kind = LH_Q_LEARNING;
    message_verdict verdict = message_decode_policy(data, size, &l->as.q_learning.policy);
    if (verdict == MESSAGE_MALFORMED) {
        l->kind = LH_PLANNER;
        verdict = message_decode_planner(data, size, &l->as.planner.planner);
    }
    return verdict;
}

message_verdict learned_decode_checkpoint(const void *data, size_t size, learned *l) {
    memset(l, 0, sizeof *l);
    l->kind = LH_Q_LEARNING;
    message_verdict verdict = message_decode_checkpoint(data, size, &l->as.q_learning);
    if (verdict == MESSAGE_MALFORMED) {
        l->kind = LH_PLANNER;
        verdict = message_decode_planner_checkpoint(data, size, &l->as.planner);
    }
    return verdict;
}
