/* Where experiments and robots lie. A program has its own in ../share/limphome/config, seen from its folder, when
 * installed as well as in a build. */
#ifndef LIMPHOME_CONFIG_PATH_H
#define LIMPHOME_CONFIG_PATH_H

#ifdef __cplusplus
extern "C" {
#endif

enum { CONFIG_PATH_LENGTH = 4096 }; /* [bytes] of a path, with its end */

/* Path of a file that the user names: `file` itself, but a name without a folder that is not in the working directory
 * is looked for among the program's own, whose path is then written to `own`. */
const char *config_path_find(const char *file, char own[CONFIG_PATH_LENGTH]);

/* Path of the default robot: the program's own, written to `own`; where it has none, that of the working directory. */
const char *config_path_robot(char own[CONFIG_PATH_LENGTH]);

#ifdef __cplusplus
}
#endif
#endif
