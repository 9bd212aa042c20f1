/* One reading of a robot file: what it had to say so far, and how numbers and names are taken from elements. A fault
 * tells file, line, element, what stands there and what is allowed; reading goes on after it, so that all are told. */
#ifndef LIMPHOME_ROBOT_READING_H
#define LIMPHOME_ROBOT_READING_H

#include <stdbool.h>

#include "arena.h"
#include "geometry.h"
#include "robot_file.h"

/* Nothing of a robot is farther away or larger, heavier, or stronger. A unit is mistaken, most likely. */
#define MOST_METRES 100.0
#define MOST_KILOGRAMS 1e6
#define MOST_EFFORT 1e9   /* [N m] */
#define MOST_VELOCITY 1e4 /* [rad/s] */

struct xml_element;

/* Lines of one kind, in the order in which they were found. */
struct remarks {
    int count, room;
    struct remark *lines;
};

struct reading {
    const char *path;
    const char *packages;
    struct arena arena;
    struct remarks faults, notices;
    robot_mesh *meshes;
    int num_meshes;
};

/* `key` is the attribute in question, shown with its value; NULL: none. */
void fault(struct reading *r, const struct xml_element *at, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void remark(struct reading *r, const struct xml_element *at, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* A fault that is none of an element's; line 0: of the whole file. */
void fault_in_line(struct reading *r, unsigned long line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Notes that a file was read besides. */
void note_mesh(struct reading *r, const char *path, const char *copy);

/* A name as the description has it: its beginning, of whole characters, without what a terminal obeys. */
void short_name(char name[ROBOT_NAME_LENGTH], const char *from);

/* Moves all remarks, in the order of the file, to the report. */
void reading_report(struct reading *r, robot_report *report);

/* A name that must be there: not empty. "" with a fault if it is not. */
const char *read_name(struct reading *r, const struct xml_element *at, const char *key);

/* `count` numbers of an attribute. False, nothing changed, if it is not there (a fault only if it is required) or
 * malformed (a fault). */
bool read_numbers(struct reading *r, const struct xml_element *at, const char *key, bool required, double *numbers,
                  int count);
/* The same of one number above 0, or not below it, up to `most`. */
bool read_positive(struct reading *r, const struct xml_element *at, const char *key, bool required, double most,
                   double *number);
bool read_not_negative(struct reading *r, const struct xml_element *at, const char *key, bool required, double most,
                       double *number);
/* The same of three numbers, each of magnitude up to `most`. */
bool read_vector(struct reading *r, const struct xml_element *at, const char *key, bool required, double most,
                 vector *v);

/* The child of that name; given twice it is a fault, the first counts. NULL if there is none. */
const struct xml_element *read_child(struct reading *r, const struct xml_element *at, const char *name);
/* The child <origin>, identity without it. */
frame read_origin(struct reading *r, const struct xml_element *at);

#endif
