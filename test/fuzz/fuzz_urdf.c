/* A robot file of any bytes is refused with a text, or gives a robot that the library accepts and can step. */
#include <string.h>

#include "sound.h"
#include "urdf.h"

static void step(const urdf_robot *read) {
    static lh_controller controller;
    lh_controlled controlled = {.count = 1, .index = {0}};
    const lh_config config = lh_config_default();
    FUZZ_EXPECT(lh_controller_init(&controller, &config, &read->robot, &controlled) == LH_OK);
    const lh_state state = {.num_actuators = read->robot.num_actuators, .orientation = {1, 0, 0, 0}};
    fuzz_step(&controller, &state);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    urdf_robot robot;
    char error[ERROR_LENGTH] = "";
    if (urdf_read(&robot, fuzz_file(data, size), error)) {
        FUZZ_EXPECT(lh_robot_validate(&robot.robot) == LH_OK);
        step(&robot);
    } else {
        FUZZ_EXPECT(error[0] != '\0' && memchr(error, '\0', sizeof error) != NULL);
    }
    return 0;
}
