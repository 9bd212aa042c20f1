#include "reading.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "xml.h"

/* What must be above 0 is not so only in double precision. */
#define LEAST 1e-9

enum { LINE_LENGTH = 1024, VALUE_LENGTH = 80, MOST_REMARKS = 1000 };

/* Once round, and what rounding adds [rad]. */
#define MOST_ANGLE (2 * 3.14159265358979323846 * 1.001)

struct remark {
    unsigned long line;
    char *text;
};

/* What reading takes is bounded; where there is none left, nothing can be told either. */
static void *need(void *memory) {
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        abort();
    }
    return memory;
}

/* Names may hold anything, and are cut anywhere: blanks what terminals obey, U+0080 to U+009F too, and what is no whole
 * UTF-8 character. */
static void tidy(char *text) {
    for (char *c = text; *c != '\0';) {
        const unsigned char lead = (unsigned char)c[0];
        const int length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
        int whole = 1;
        while (whole < length && ((unsigned char)c[whole] & 0xc0) == 0x80) {
            whole++;
        }
        const bool control = lead < ' ' || lead == 0x7f || (lead == 0xc2 && (unsigned char)c[1] < 0xa0);
        if (whole != length || control) {
            memset(c, ' ', (size_t)whole);
        }
        c += whole;
    }
}

void short_name(char name[ROBOT_NAME_LENGTH], const char *from) {
    snprintf(name, ROBOT_NAME_LENGTH, "%.*s", ROBOT_NAME_LENGTH - 1, from);
    tidy(name);
}

static void add(struct remarks *remarks, unsigned long line, const char *text) {
    if (remarks->count == MOST_REMARKS) { /* nobody reads more */
        return;
    }
    if (remarks->count == remarks->room) {
        remarks->room = 2 * remarks->room + 8;
        remarks->lines = need(realloc(remarks->lines, (size_t)remarks->room * sizeof *remarks->lines));
    }
    char *copy = need(strdup(text));
    tidy(copy); /* a remark is one line */
    remarks->lines[remarks->count++] = (struct remark){line, copy};
}

__attribute__((format(printf, 2, 3))) static void append(char *text, const char *format, ...) {
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, LINE_LENGTH - length, format, arguments);
    va_end(arguments);
}

static void append_element(char *text, const struct xml_element *e, const char *key) {
    static const char *const identifying[] = {"name", "joint", "link", "filename"};
    for (size_t i = 0; i < sizeof identifying / sizeof identifying[0] && key == NULL; i++) {
        key = xml_attribute(e, identifying[i]) != NULL ? identifying[i] : NULL;
    }
    key = key == NULL ? e->attributes[0] : key;
    append(text, "<%.60s", e->name);
    const char *value = key != NULL ? xml_attribute(e, key) : NULL;
    if (value != NULL) {
        append(text, " %.40s=\"%.*s%s\"", key, VALUE_LENGTH, value, strlen(value) > VALUE_LENGTH ? "..." : "");
    }
    append(text, ">");
}

/* The element that stands in <robot> and then, if it is another, the one in question. */
static void append_place(char *text, const struct xml_element *e, const char *key) {
    const struct xml_element *outer = e;
    while (outer->parent != NULL && outer->parent->parent != NULL) {
        outer = outer->parent;
    }
    if (outer != e) {
        append_element(text, outer, NULL);
        append(text, " ");
    }
    append_element(text, e, key);
}

static void add_at(struct reading *r, struct remarks *remarks, const struct xml_element *at, const char *key,
                   const char *format, va_list arguments) {
    char text[LINE_LENGTH];
    snprintf(text, sizeof text, "%.300s:%lu: ", r->path, at->line);
    append_place(text, at, key);
    append(text, ": ");
    const size_t length = strlen(text);
    vsnprintf(text + length, sizeof text - length, format, arguments);
    add(remarks, at->line, text);
}

void fault(struct reading *r, const struct xml_element *at, const char *key, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add_at(r, &r->faults, at, key, format, arguments);
    va_end(arguments);
}

void remark(struct reading *r, const struct xml_element *at, const char *key, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add_at(r, &r->notices, at, key, format, arguments);
    va_end(arguments);
}

void fault_in_line(struct reading *r, unsigned long line, const char *format, ...) {
    char text[LINE_LENGTH];
    int length = snprintf(text, sizeof text, "%.300s:", r->path);
    if (line > 0) {
        length += snprintf(text + length, sizeof text - (size_t)length, "%lu:", line);
    }
    text[length++] = ' ';
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, sizeof text - (size_t)length, format, arguments);
    va_end(arguments);
    add(&r->faults, line, text);
}

void note_mesh(struct reading *r, const char *path, const char *copy) {
    for (int i = 0; i < r->num_meshes; i++) {
        if (strcmp(r->meshes[i].copy, copy) == 0) {
            return;
        }
    }
    r->meshes = need(realloc(r->meshes, (size_t)(r->num_meshes + 1) * sizeof *r->meshes));
    r->meshes[r->num_meshes++] = (robot_mesh){need(strdup(path)), need(strdup(copy))};
}

/* In the order of the lines; what is of one line stays in its order. Few are out of order. */
static char **texts_in_order(struct remarks *remarks, int *count) {
    for (int i = 1; i < remarks->count; i++) {
        for (int k = i; k > 0 && remarks->lines[k - 1].line > remarks->lines[k].line; k--) {
            const struct remark later = remarks->lines[k - 1];
            remarks->lines[k - 1] = remarks->lines[k];
            remarks->lines[k] = later;
        }
    }
    char **texts = need(calloc((size_t)remarks->count + 1, sizeof *texts));
    for (int i = 0; i < remarks->count; i++) {
        texts[i] = remarks->lines[i].text;
    }
    *count = remarks->count;
    free(remarks->lines);
    *remarks = (struct remarks){0};
    return texts;
}

void reading_report(struct reading *r, robot_report *report) {
    report->faults = texts_in_order(&r->faults, &report->num_faults);
    report->notices = texts_in_order(&r->notices, &report->num_notices);
    report->meshes = r->meshes;
    report->num_meshes = r->num_meshes;
}

const char *read_name(struct reading *r, const struct xml_element *at, const char *key) {
    const char *name = xml_attribute(at, key);
    if (name == NULL) {
        fault(r, at, NULL, "needs %s=\"...\"", key);
    } else if (name[0] == '\0') {
        fault(r, at, key, "must not be empty");
    }
    return name == NULL ? "" : name;
}

/* The number that begins at *at, behind white space; *at goes on behind it. */
static bool next_number(const char **at, double *number) {
    static const char space[] = " \t\r\n", digits[] = "+-.0123456789eE";
    *at += strspn(*at, space);
    const size_t length = strcspn(*at, space);
    char *end = NULL;
    *number = strtod(*at, &end);
    if (length == 0 || strspn(*at, digits) < length || end != *at + length || !isfinite(*number)) {
        return false;
    }
    *at = end + strspn(end, space);
    return true;
}

bool read_numbers(struct reading *r, const struct xml_element *at, const char *key, bool required, double *numbers,
                  int count) {
    const char *value = xml_attribute(at, key);
    if (value == NULL) {
        if (required) {
            fault(r, at, NULL, "needs %s=\"...\"", key);
        }
        return false;
    }
    double read[6];
    bool good = true;
    const char *next = value;
    for (int i = 0; i < count && good; i++) {
        good = next_number(&next, &read[i]);
    }
    if (!good || next[0] != '\0') {
        fault(r, at, key,
              count == 1 ? "must be %d number, such as 0.5" : "must be %d numbers, such as 0.5, with spaces between",
              count);
        return false;
    }
    memcpy(numbers, read, (size_t)count * sizeof *numbers);
    return true;
}

bool read_positive(struct reading *r, const struct xml_element *at, const char *key, bool required, double most,
                   double *number) {
    double read = 0;
    if (!read_numbers(r, at, key, required, &read, 1)) {
        return false;
    }
    if (!(read >= LEAST && read <= most)) {
        fault(r, at, key, "must be above 0 and at most %g", most);
        return false;
    }
    *number = read;
    return true;
}

bool read_not_negative(struct reading *r, const struct xml_element *at, const char *key, bool required, double most,
                       double *number) {
    double read = 0;
    if (!read_numbers(r, at, key, required, &read, 1)) {
        return false;
    }
    if (!(read >= 0 && read <= most)) {
        fault(r, at, key, "must be 0 or more and at most %g", most);
        return false;
    }
    *number = read;
    return true;
}

bool read_vector(struct reading *r, const struct xml_element *at, const char *key, bool required, double most,
                 vector *v) {
    double read[3];
    if (!read_numbers(r, at, key, required, read, 3)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        if (fabs(read[i]) > most) {
            fault(r, at, key, "must be numbers of at most %g", most);
            return false;
        }
    }
    *v = vector_of(read);
    return true;
}

const struct xml_element *read_child(struct reading *r, const struct xml_element *at, const char *name) {
    const struct xml_element *child = xml_child(at, name);
    const struct xml_element *again = child != NULL ? xml_again(child) : NULL;
    for (; again != NULL; again = xml_again(again)) {
        fault(r, again, NULL, "is given twice, first in line %lu; once is allowed", child->line);
    }
    return child;
}

frame read_origin(struct reading *r, const struct xml_element *at) {
    const struct xml_element *origin = read_child(r, at, "origin");
    vector xyz = {0, 0, 0}, rpy = {0, 0, 0};
    if (origin != NULL) {
        read_vector(r, origin, "xyz", false, MOST_METRES, &xyz);
        if (read_vector(r, origin, "rpy", false, 1e6, &rpy) &&
            (fabs(rpy.x) > MOST_ANGLE || fabs(rpy.y) > MOST_ANGLE || fabs(rpy.z) > MOST_ANGLE)) {
            fault(r, origin, "rpy", "is more than once round (6.283 rad), as if in degrees; must be in radians");
        }
    }
    return frame_from_rpy(xyz, rpy);
}
