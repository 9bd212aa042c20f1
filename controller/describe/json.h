/* JSON, written as it is told: each call puts the comma that is due. `name` is NULL inside an array. */
#ifndef LIMPHOME_DESCRIBE_JSON_H
#define LIMPHOME_DESCRIBE_JSON_H

#include <stdbool.h>
#include <stdio.h>

typedef struct json {
    FILE *out;
    bool first; /* nothing has been written yet since the last bracket opened */
} json;

/* `bracket`: '{' or '['. */
void json_open(json *j, const char *name, char bracket);
void json_close(json *j, char bracket);

void json_text(json *j, const char *name, const char *text);
void json_bool(json *j, const char *name, bool value);
void json_whole(json *j, const char *name, int value);
/* So that it reads back as the same double; null where it is not finite. */
void json_number(json *j, const char *name, double value);
void json_numbers(json *j, const char *name, const double *values, int count);

#endif
