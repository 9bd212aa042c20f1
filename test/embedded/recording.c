#include "recording.h"

#include "platform.h"

int recording_open(lh_controller *controller, int32_t *decisions) {
    static recording_header header;
    const int file = platform_open(RECORDING_FILE, false);
    if (file < 0 || !platform_read(file, &header, sizeof header)) {
        platform_say("there is no " RECORDING_FILE "\n");
        return -1;
    }
    if (header.header_size != sizeof header || header.state_size != sizeof(lh_state)) {
        platform_say(RECORDING_FILE " has structs of another size\n");
        return -1;
    }
    if (lh_controller_init(controller, &header.config, &header.robot, &header.controlled) != LH_OK) {
        platform_say(RECORDING_FILE " has a bad configuration\n");
        return -1;
    }
    *decisions = header.decisions;
    return file;
}

bool recording_next(int file, lh_state *state) {
    return platform_read(file, state, sizeof *state);
}
