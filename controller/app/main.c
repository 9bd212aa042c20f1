/* limphome-controller: the process around the library. Exit codes: ending.h. */
#include <signal.h>
#include <stdio.h>

#include "command_line.h"
#include "ending.h"
#include "process.h"
#include "robot_file.h"

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
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_CONTROLLER, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? ENDING_DONE : ENDING_BAD_INPUT;
    }
    if (line.list_meshes) {
        return list_meshes(&line) ? ENDING_DONE : ENDING_BAD_INPUT;
    }
    static robot_description robot; /* both too large for a comfortable stack frame */
    static run r;
    if (!robot_file_load(line.robot, line.packages, &robot)) {
        return ENDING_BAD_INPUT;
    }
    if (line.check) {
        const bool good = run_check(&r, &line, &robot);
        if (!good) {
            fprintf(stderr, "%s\n", r.error);
        }
        return good ? ENDING_DONE : ENDING_BAD_INPUT;
    }
    process_end_on_signals(on_signal);
    if (!run_open(&r, &line, &robot)) {
        fprintf(stderr, "%s\n", r.error);
        return ENDING_BAD_INPUT;
    }
    return (int)ending_close(&r, run_decide(&r, &stop));
}
