/* What limphome-describe tells, for people and for programs. */
#ifndef LIMPHOME_DESCRIBE_PRINT_H
#define LIMPHOME_DESCRIBE_PRINT_H

#include <stdio.h>

#include "facts.h"
#include "robot_description.h"
#include "robot_file.h"

/* The robot in words. Notices are not among them: like the programs, limphome-describe puts these on stderr. */
void print_text(FILE *out, const robot_description *robot, const robot_facts *facts);

/* All numbers. Of a file that is refused, `robot` is NULL: what reading had to say, and no more. */
void print_json(FILE *out, const char *path, const robot_report *report, const robot_description *robot,
                const robot_facts *facts);

#endif
