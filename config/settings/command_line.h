/* The command line that the programs share: --config, --set, --robot, --lcm-url and what prints and exits. */
#ifndef LIMPHOME_COMMAND_LINE_H
#define LIMPHOME_COMMAND_LINE_H

#include <stdbool.h>

#include "config_path.h"
#include "settings.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct command_line {
    struct settings settings; /* as resolved: defaults, then --config, then each --set */
    const char *robot;        /* --robot, a URDF file; may point to own_robot */
    const char *packages;     /* --packages, folders for package://, separated by ':', or NULL */
    const char *lcm_url;      /* --lcm-url; NULL: LCM's own default, which follows LCM_DEFAULT_URL */
    const char *out;          /* but for the simulator: --out, the run folder, or NULL */
    const char *evaluate;     /* likewise: --evaluate, a policy file, or NULL */
    bool resume;              /* likewise: --resume */
    bool list_meshes;         /* controller: --list-meshes: print them and exit */
    bool check;               /* --check: read and check all, and exit */
    char own_robot[CONFIG_PATH_LENGTH];
} command_line;

/* Which program asks. */
typedef enum command_line_program {
    COMMAND_LINE_CONTROLLER,
    COMMAND_LINE_SIMULATOR,
    COMMAND_LINE_PAIR
} command_line_program;

typedef enum command_line_result {
    COMMAND_LINE_RUN,  /* go on */
    COMMAND_LINE_DONE, /* what was asked for has been printed: exit 0 */
    COMMAND_LINE_BAD   /* an error has been printed: exit 2 */
} command_line_result;

/* Prepares the standard streams and reads argv into `line`, whose strings point into argv or itself: it is not to be
 * copied. */
command_line_result command_line_parse(int argc, char **argv, command_line_program program, command_line *line);

#ifdef __cplusplus
}
#endif
#endif
