/* Lines on stderr about what may go on for ever: of each kind one a second at most, with the number left out since. */
#ifndef LIMPHOME_NOTICE_H
#define LIMPHOME_NOTICE_H

#ifdef __cplusplus
extern "C" {
#endif

/* One kind of line; begins as {0}. */
typedef struct notice {
    double due;         /* no line before then [s, monotonic] */
    unsigned long kept; /* lines not printed since the last one */
} notice;

/* Prints a line at `now` [s, monotonic], unless one of its kind was printed within the last second. */
void notice_print(notice *n, double now, const char *format, ...) __attribute__((format(printf, 3, 4)));

#ifdef __cplusplus
}
#endif
#endif
