/* Reads a robot file (URDF with a <limphome> element) for both programs: the same file is to both the same robot, or
 * refused with the same text. docs/robot.md describes the format. */
#ifndef LIMPHOME_ROBOT_FILE_H
#define LIMPHOME_ROBOT_FILE_H

#include <stdbool.h>

#include "robot_description.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct robot_mesh {
    char *path; /* of a file that was read besides */
    char *copy; /* where a copy of it is found before all else, seen from the folder of the robot file */
} robot_mesh;

/* What reading had to say, a line each with file, line, element, what stands there and what is allowed; in the order of
 * the file. Owned by the caller, freed by robot_report_free. */
typedef struct robot_report {
    int num_faults;
    char **faults; /* [num_faults] why the file is refused */
    int num_notices;
    char **notices; /* [num_notices] what was taken otherwise than it stands there, and why */
    int num_meshes;
    robot_mesh *meshes; /* [num_meshes] */
} robot_report;

void robot_report_free(robot_report *report);

/* Reads `path`. `packages` is a list of folders separated by ':' in which package:// is looked for first, or NULL; then
 * it is looked for in the folders above the file. True, and `robot` is whole; or false, `robot` is not changed, and
 * report->num_faults is above 0. Either way `report` is filled and is to be freed. */
bool robot_file_read(const char *path, const char *packages, robot_description *robot, robot_report *report);

/* The same for a program: what is to be told goes to stderr, the faults or, of a robot that is accepted, the notices;
 * 20 lines at most, and how many more there are. */
bool robot_file_load(const char *path, const char *packages, robot_description *robot);

#ifdef __cplusplus
}
#endif
#endif
