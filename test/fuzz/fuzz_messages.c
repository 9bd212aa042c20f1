/* States, policies, checkpoints and what operators want as bytes from the network or a file: refused, or good for the
 * library. What is good encodes to the same bytes. */
#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "convert.h"
#include "crawler.h"
#include "learned.h"
#include "messages.h"
#include "sound.h"

enum { LARGEST = LEARNED_LARGEST };
enum kind { STATE, POLICY, CHECKPOINT, OPERATE, KINDS };

static lh_controller controller;
static learned saved;

/* Makes `controller` one of that kind that has learned nothing; a planner plans when it is made, so that is done once.
 */
static void start(lh_learner_kind kind) {
    static lh_controller fresh[2];
    static bool made[2];
    if (!made[kind]) {
        lh_config config = lh_config_default();
        config.learner.kind = kind;
        const lh_robot robot = crawler_robot();
        const lh_controlled controlled = crawler_controlled();
        FUZZ_EXPECT(lh_controller_init(&fresh[kind], &config, &robot, &controlled) == LH_OK);
        made[kind] = true;
    }
    memcpy(&controller, &fresh[kind], sizeof controller);
}

static void decode_state(const uint8_t *bytes, size_t size) {
    limphome_robot_state_t message;
    if (message_decode_state(bytes, size, &message) == MESSAGE_GOOD) {
        const lh_state state = convert_state(&message);
        fuzz_step(&controller, &state);
        fuzz_step(&controller, &state);
        const lh_controlled controlled = convert_controlled(&message);
        const lh_config config = lh_config_default();
        const lh_robot robot = crawler_robot();
        if (lh_controller_init(&controller, &config, &robot, &controlled) == LH_OK) {
            fuzz_step(&controller, &state);
        }
        uint8_t again[LARGEST];
        FUZZ_EXPECT(limphome_robot_state_t_encode(again, 0, (int)size, &message) == (int)size);
        FUZZ_EXPECT(memcmp(again, bytes, size) == 0);
    }
}

/* Two steps of a controller that has gone on from `saved`, if that fits. */
static void expect_sound_steps(void) {
    static lh_learned restored;
    if (learned_restore(&saved, &controller, &restored)) {
        lh_controller_restore(&controller, &restored, learned_episode(&saved));
    }
    const lh_state state = crawler_state(0.0f, 0.0f, 1.5f);
    fuzz_step(&controller, &state);
    fuzz_step(&controller, &state);
}

static void decode_policy(const uint8_t *bytes, size_t size) {
    if (learned_decode_policy(bytes, size, &saved) == MESSAGE_GOOD) {
        expect_sound_steps();
        static uint8_t again[LARGEST];
        FUZZ_EXPECT(learned_encode_policy(&saved, again, (int)size) == (int)size);
        FUZZ_EXPECT(memcmp(again, bytes, size) == 0);
    }
}

static void decode_checkpoint(const uint8_t *bytes, size_t size) {
    if (learned_decode_checkpoint(bytes, size, &saved) == MESSAGE_GOOD) {
        expect_sound_steps();
        static uint8_t again[LARGEST];
        FUZZ_EXPECT(learned_encode_checkpoint(&saved, again, (int)size) == (int)size);
        FUZZ_EXPECT(memcmp(again, bytes, size) == 0);
    }
}

static void decode_operate(const uint8_t *bytes, size_t size) {
    limphome_operate_t message;
    if (message_decode_operate(bytes, size, &message) == MESSAGE_GOOD) {
        const lh_state state = crawler_state(0.0f, 0.0f, 1.5f);
        lh_decision decision;
        FUZZ_EXPECT(lh_controller_drive(&controller, &state, message.direction, &decision) == LH_OK);
        fuzz_step(&controller, &state);
        uint8_t again[LARGEST];
        FUZZ_EXPECT(limphome_operate_t_encode(again, 0, (int)size, &message) == (int)size);
        FUZZ_EXPECT(memcmp(again, bytes, size) == 0);
    }
}

/* A message that is accepted. */
static size_t good_message(enum kind kind, uint8_t bytes[LARGEST]) {
    const limphome_robot_state_t state = {.num_actuators = 5, .orientation = {1}};
    const limphome_operate_t operate = {.sender = 1, .num_actuators = 5};
    learned_save(&saved, &controller, 7, 0, 99);
    int size = 0;
    switch (kind) {
        case STATE:
            size = limphome_robot_state_t_encode(bytes, 0, LARGEST, &state);
            break;
        case OPERATE:
            size = limphome_operate_t_encode(bytes, 0, LARGEST, &operate);
            break;
        case POLICY:
            size = learned_encode_policy(&saved, bytes, LARGEST);
            break;
        default:
            size = learned_encode_checkpoint(&saved, bytes, LARGEST);
            break;
    }
    FUZZ_EXPECT(size > 0);
    return (size_t)size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static void (*const decode[KINDS])(const uint8_t *, size_t) = {decode_state, decode_policy, decode_checkpoint,
                                                                   decode_operate};
    fuzz_input in = {data, size};
    const uint8_t choice = fuzz_byte(&in);
    start((choice & 32) != 0 ? LH_PLANNER : LH_Q_LEARNING);
    const enum kind kind = (choice & 31) % KINDS;
    if (choice & 128) { /* the bytes as they are */
        decode[kind](in.data, in.size);
        return 0;
    }
    static uint8_t bytes[LARGEST];
    memset(bytes, 0, sizeof bytes);
    size_t length = good_message(kind, bytes);
    if (choice & 64) { /* of another length */
        length = (length + (size_t)fuzz_byte(&in) - 128) % LARGEST;
    }
    fuzz_patch(&in, bytes, length, 1);
    if (kind == POLICY || kind == CHECKPOINT) {
        checksum_seal(bytes, (int)length); /* or nothing would get past the checksum */
    }
    uint8_t *exact = malloc(length); /* for the sanitizer to see a read beyond the end */
    FUZZ_EXPECT(exact != NULL);
    memcpy(exact, bytes, length);
    decode[kind](exact, length);
    free(exact);
    return 0;
}
