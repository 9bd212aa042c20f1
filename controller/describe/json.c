#include "json.h"

#include <math.h>

static void put_text(const json *j, const char *text) {
    fputc('"', j->out);
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0'; c++) {
        if (*c == '"' || *c == '\\') {
            fprintf(j->out, "\\%c", *c);
        } else if (*c < 0x20) {
            fprintf(j->out, "\\u%04x", *c);
        } else {
            fputc(*c, j->out);
        }
    }
    fputc('"', j->out);
}

/* What stands before a value. */
static void begin(json *j, const char *name) {
    if (!j->first) {
        fputs(", ", j->out);
    }
    j->first = false;
    if (name != NULL) {
        put_text(j, name);
        fputs(": ", j->out);
    }
}

void json_open(json *j, const char *name, char bracket) {
    begin(j, name);
    fputc(bracket, j->out);
    j->first = true;
}

void json_close(json *j, char bracket) {
    fputc(bracket, j->out);
    j->first = false;
}

void json_text(json *j, const char *name, const char *text) {
    begin(j, name);
    put_text(j, text);
}

void json_bool(json *j, const char *name, bool value) {
    begin(j, name);
    fputs(value ? "true" : "false", j->out);
}

void json_whole(json *j, const char *name, int value) {
    begin(j, name);
    fprintf(j->out, "%d", value);
}

void json_number(json *j, const char *name, double value) {
    begin(j, name);
    if (isfinite(value)) {
        fprintf(j->out, "%.17g", value);
    } else {
        fputs("null", j->out);
    }
}

void json_numbers(json *j, const char *name, const double *values, int count) {
    json_open(j, name, '[');
    for (int i = 0; i < count; i++) {
        json_number(j, NULL, values[i]);
    }
    json_close(j, ']');
}
