/* limphome-controller: the process around the library. Exit 0: all episodes done; 130: stopped by a signal;
 * 1: something went wrong on the way; 2: bad input, nothing was started; 3: given up, there was no plant that obeys. */
#include <signal.h>
#include <stdio.h>

#include "command_line.h"
#include "process.h"
#include "robot_file.h"
#include "run.h"

static volatile sig_atomic_t stop;

static void on_signal(int number) {
    stop = number;
}

int main(int argc, char **argv) {
    enum { DONE = 0, WENT_WRONG = 1, BAD_INPUT = 2, GAVE_UP = 3, STOPPED = 130 };
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_CONTROLLER, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? DONE : BAD_INPUT;
    }
    static robot_description robot; /* both too large for a comfortable stack frame */
    static run r;
    if (!robot_file_load(line.robot, line.packages, &robot)) {
        return BAD_INPUT;
    }
    if (line.check) {
        const bool good = run_check(&r, &line, &robot);
        if (!good) {
            fprintf(stderr, "%s\n", r.error);
        }
        return good ? DONE : BAD_INPUT;
    }
    process_end_on_signals(on_signal);
    if (!run_open(&r, &line, &robot)) {
        fprintf(stderr, "%s\n", r.error);
        return BAD_INPUT;
    }
    const bool complete = run_decide(&r, &stop);
    if (!run_close(&r, complete)) {
        fprintf(stderr, "%s\n", r.error);
        return r.gave_up ? GAVE_UP : WENT_WRONG;
    }
    if (!complete) {
        fprintf(stderr, "stopped after episode %d\n", r.finished);
        return STOPPED;
    }
    return DONE;
}
