/* What was learned, as messages: policy.lcm, the files in checkpoint/ and what goes over the bus. Each kind of learner
 * has messages of its own, and a pair of files learned_<kind> between them and the library; all else in the process
 * sees them as one type. LCM's fingerprint tells of which kind some bytes are. */
#ifndef LIMPHOME_APP_LEARNED_H
#define LIMPHOME_APP_LEARNED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "limphome/controller.h"
#include "limphome_checkpoint_t.h"
#include "limphome_planner_checkpoint_t.h"
#include "messages.h"

enum { LEARNED_LARGEST = 65536 }; /* bytes of an encoded message */

typedef struct learned {
    lh_learner_kind kind;
    bool policy_only; /* without what it takes beside the policy to go on learning */
    union {
        limphome_checkpoint_t q_learning;
        limphome_planner_checkpoint_t planner;
    } as; /* by kind */
} learned;

/* Fills in what `controller` has learned after `episode` finished episodes. */
void learned_save(learned *l, const lh_controller *controller, int32_t episode, int64_t utime, int64_t settings_hash);

/* What lh_controller_restore takes; what a policy does not tell is as the controller has it. False if it is of another
 * kind of learner, or for other actuators, speeds or ranges than the controller's: it would not mean the same. */
bool learned_restore(const learned *l, const lh_controller *controller, lh_learned *restored);

/* Finished episodes it has learned from. */
int32_t learned_episode(const learned *l);

/* The actuators that it was learned for. */
lh_controlled learned_controlled(const learned *l);

/* Of the settings and the robot that a run must share to go on with it; not of a policy. */
int64_t learned_settings_hash(const learned *l);

/* Channel on which a policy of its kind is told. */
const char *learned_channel(const learned *l);

/* Each seals what it writes with its checksum and returns the number of bytes, or -1 if these are more than `size`. */
int learned_encode_policy(const learned *l, unsigned char *bytes, int size);
int learned_encode_checkpoint(const learned *l, unsigned char *bytes, int size);

/* Each takes exactly `size` bytes; on anything but MESSAGE_GOOD *l is not to be used. */
message_verdict learned_decode_policy(const void *data, size_t size, learned *l);
message_verdict learned_decode_checkpoint(const void *data, size_t size, learned *l);

#endif
