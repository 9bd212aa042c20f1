/* The robot of a file of config/, as the library has it. */
#ifndef LIMPHOME_TEST_ROBOT_OF_H
#define LIMPHOME_TEST_ROBOT_OF_H

#include "convert_robot.h"
#include "robot_file.h"
#include "suite.h"

static inline lh_robot robot_of(const char *path) {
    robot_description read;
    lh_robot robot;
    char error[ERROR_LENGTH] = "";
    ck_assert(robot_file_load(path, NULL, &read));
    ck_assert_msg(convert_robot(&read, &robot, error), "%s", error);
    return robot;
}

#endif
