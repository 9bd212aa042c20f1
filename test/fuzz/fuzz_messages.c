/* States, policies and checkpoints as bytes from the network or a file: refused, or good for the library. What is good
 * encodes to the same bytes. */
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "crawler.h"
#include "messages.h"
#include "sound.h"

enum { LARGEST = 8192 };
enum kind { STATE, POLICY, CHECKPOINT, KINDS };

static lh_controller controller;

static void start(void) {
    const lh_config config = lh_config_default();
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    FUZZ_EXPECT(lh_controller_init(&controller, &config, &robot, &controlled) == LH_OK);
}

/* Two steps of a controller that has gone on from `learned`, if that was good. */
static void expect_sound_steps(const lh_learned *learned, bool good, int32_t episode) {
    if (good) {
        lh_controller_restore(&controller, learned, episode);
    }
    const lh_state state = crawler_state(0.0f, 0.0f, 1.5f);
    fuzz_step(&controller, &state);
    fuzz_step(&controller, &state);
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

static void decode_policy(const uint8_t *bytes, size_t size) {
    limphome_policy_t policy;
    if (message_decode_policy(bytes, size, &policy) == MESSAGE_GOOD) {
        lh_learned learned;
        expect_sound_steps(&learned, convert_from_policy(&policy, &controller, &learned), policy.episode);
        uint8_t again[LARGEST];
        FUZZ_EXPECT(limphome_policy_t_encode(again, 0, (int)size, &policy) == (int)size);
        FUZZ_EXPECT(memcmp(again, bytes, size) == 0);
    }
}

static void decode_checkpoint(const uint8_t *bytes, size_t size) {
    limphome_checkpoint_t checkpoint;
    if (message_decode_checkpoint(bytes, size, &checkpoint) == MESSAGE_GOOD) {
        lh_learned learned;
        expect_sound_steps(&learned, convert_from_checkpoint(&checkpoint, &controller, &learned), checkpoint.episode);
        uint8_t again[LARGEST];
        FUZZ_EXPECT(limphome_checkpoint_t_encode(again, 0, (int)size, &checkpoint) == (int)size);
        FUZZ_EXPECT(memcmp(again, bytes, size) == 0);
    }
}

/* A message that is accepted. */
static size_t good_message(enum kind kind, uint8_t bytes[LARGEST]) {
    const limphome_robot_state_t state = {.num_actuators = 5, .orientation = {1}};
    const limphome_checkpoint_t checkpoint = convert_checkpoint(&controller, 7, 0, 99);
    int size = 0;
    switch (kind) {
        case STATE:
            size = limphome_robot_state_t_encode(bytes, 0, LARGEST, &state);
            break;
        case POLICY:
            size = limphome_policy_t_encode(bytes, 0, LARGEST, &checkpoint.policy);
            break;
        default:
            size = limphome_checkpoint_t_encode(bytes, 0, LARGEST, &checkpoint);
            break;
    }
    FUZZ_EXPECT(size > 0);
    return (size_t)size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static void (*const decode[KINDS])(const uint8_t *, size_t) = {decode_state, decode_policy, decode_checkpoint};
    start();
    fuzz_input in = {data, size};
    const uint8_t choice = fuzz_byte(&in);
    const enum kind kind = choice % KINDS;
    if (choice & 128) { /* the bytes as they are */
        decode[kind](in.data, in.size);
        return 0;
    }
    uint8_t bytes[LARGEST] = {0};
    size_t length = good_message(kind, bytes);
    if (choice & 64) { /* of another length */
        length = (length + (size_t)fuzz_byte(&in) - 128) % LARGEST;
    }
    fuzz_patch(&in, bytes, length, 1);
    uint8_t *exact = malloc(length); /* for the sanitizer to see a read beyond the end */
    FUZZ_EXPECT(exact != NULL);
    memcpy(exact, bytes, length);
    decode[kind](exact, length);
    free(exact);
    return 0;
}
