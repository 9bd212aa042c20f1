#include "notice.h"

#include <stdarg.h>
#include <stdio.h>

enum { LINE_LENGTH = 256 };
static const double interval = 1; /* [s] */

void notice_print(notice *n, double now, const char *format, ...) {
    if (now < n->due) {
        n->kept++;
        return;
    }
    char line[LINE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (n->kept > 0) {
        fprintf(stderr, "%s (and %lu times more since the last such line)\n", line, n->kept);
    } else {
        fprintf(stderr, "%s\n", line);
    }
    *n = (notice){.due = now + interval};
}
