/* A robot file of any bytes is refused with a text, or gives a robot that the library accepts and can step. */
#include <string.h>

#include "convert_robot.h"
#include "robot_file.h"
#include "sound.h"

static void step(const lh_robot *robot) {
    static lh_controller controller;
    lh_controlled controlled = {.count = 1, .index = {0}};
    const lh_config config = lh_config_default();
    FUZZ_EXPECT(lh_controller_init(&controller, &config, robot, &controlled) == LH_OK);
    const lh_state state = {.num_actuators = robot->num_actuators, .orientation = {1, 0, 0, 0}};
    fuzz_step(&controller, &state);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    robot_description read;
    robot_report report;
    if (robot_file_read(fuzz_file(data, size), NULL, &read, &report)) {
        lh_robot robot;
        char error[ERROR_LENGTH] = "";
        FUZZ_EXPECT(report.num_faults == 0 && convert_robot(&read, &robot, error));
        step(&robot);
    } else {
        FUZZ_EXPECT(report.num_faults > 0);
    }
    for (int i = 0; i < report.num_faults; i++) {
        FUZZ_EXPECT(report.faults[i][0] != '\0' && strchr(report.faults[i], '\n') == NULL);
    }
    robot_report_free(&report);
    return 0;
}
