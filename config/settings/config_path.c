#include "config_path.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Whether the program has `name` of its own; its path is then in `path`. */
static bool find_own(const char *name, char path[CONFIG_PATH_LENGTH]) {
    const ssize_t length = readlink("/proc/self/exe", path, CONFIG_PATH_LENGTH);
    if (length < 0 || length == CONFIG_PATH_LENGTH) {
        return false;
    }
    path[length] = '\0';
    for (int up = 0; up < 2; up++) { /* from prefix/bin/program to prefix */
        char *slash = strrchr(path, '/');
        if (slash == NULL) {
            return false;
        }
        *slash = '\0';
    }
    const size_t prefix = strlen(path), rest = CONFIG_PATH_LENGTH - prefix;
    const int needed = snprintf(path + prefix, rest, "/share/limphome/config/%s", name);
    return needed > 0 && (size_t)needed < rest && access(path, R_OK) == 0;
}

const char *config_path_find(const char *file, char own[CONFIG_PATH_LENGTH]) {
    const bool as_it_stands = strchr(file, '/') != NULL || access(file, F_OK) == 0;
    return !as_it_stands && find_own(file, own) ? own : file;
}

const char *config_path_robot(char own[CONFIG_PATH_LENGTH]) {
    return find_own("crawler.urdf", own) ? own : "config/crawler.urdf";
}
