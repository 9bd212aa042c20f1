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

/* Prints what the robot file needs besides; whether it could be read. */
static bool list_meshes(const command_line *line) {
    static robot_description robot;
    robot_report report;
    const bool good = robot_file_read(line->robot, line->packages, &robot, &report);
    for (int i = 0; i < report.num_meshes; i++) {
        printf("%s\t%s\n", report.meshes[i].copy, report.meshes[i].path);
    }
    robot_report_free(&report);
    return good && fflush(stdout) == 0;
}

int main(int argc, char **argv) {
    enum { DONE = 0, WENT_WRONG = 1, BAD_INPUT = 2, GAVE_UP = 3, STOPPED = 130 };
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_CONTROLLER, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? DONE : BAD_INPUT;
    }
    if (line.list_meshes) {
        return list_meshes(&line) ? DONE : BAD_INPUT;
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
