/* Checked decoding: messages and files are untrusted. LCM's decoders accept trailing bytes, NaN and any count. */
#ifndef LIMPHOME_APP_MESSAGES_H
#define LIMPHOME_APP_MESSAGES_H

#include <stddef.h>

#include "limphome_checkpoint_t.h"
#include "limphome_operate_t.h"
#include "limphome_planner_checkpoint_t.h"
#include "limphome_planner_t.h"
#include "limphome_policy_t.h"
#include "limphome_robot_state_t.h"

typedef enum message_verdict {
    MESSAGE_GOOD,
    MESSAGE_MALFORMED, /* another type, length or count */
    MESSAGE_DAMAGED,   /* what was learned, and its checksum is not that of its bytes */
    MESSAGE_NON_FINITE /* NaN or infinity inside */
} message_verdict;

/* Each decodes exactly `size` bytes; on anything but MESSAGE_GOOD the output is not to be used. */
message_verdict message_decode_state(const void *data, size_t size, limphome_robot_state_t *state);
message_verdict message_decode_operate(const void *data, size_t size, limphome_operate_t *operate);
message_verdict message_decode_policy(const void *data, size_t size, limphome_policy_t *policy);
message_verdict message_decode_checkpoint(const void *data, size_t size, limphome_checkpoint_t *checkpoint);
message_verdict message_decode_planner(const void *data, size_t size, limphome_planner_t *planner);
message_verdict message_decode_planner_checkpoint(const void *data, size_t size,
                                                  limphome_planner_checkpoint_t *checkpoint);

/* One sentence for an error text. */
const char *message_verdict_text(message_verdict verdict);

#endif
