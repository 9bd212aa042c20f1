/* The robot's URDF, read with expat into the library's plain struct. */
#ifndef LIMPHOME_APP_URDF_H
#define LIMPHOME_APP_URDF_H

#include <stdbool.h>
#include <stdint.h>

#include "fail.h"
#include "limphome/body/robot.h"

enum { URDF_NAME_LENGTH = 48 };

/* The robot and what only the process around the library needs to know of it. */
typedef struct urdf_robot {
    lh_robot robot;
    char actuator_name[LH_MAX_ACTUATORS][URDF_NAME_LENGTH]; /* names of the joints */
    uint64_t hash;                                          /* of the file's bytes (FNV-1a) */
} urdf_robot;

/* Reads links, joints and the <limphome> element: crawlers (left, right), arm joints from root to tip, supports and
 * tip. False, nothing changed, and a text with file, line and element in `error`, if it cannot. */
bool urdf_read(urdf_robot *robot, const char *path, char error[ERROR_LENGTH]);

#endif
