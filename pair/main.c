/* limphome-pair: limphome-controller and limphome-simulator in one process. Both are what they are on a network,
 * session and link included, and leave the same files; but a message is handed over by a call, and no process wakes
 * another. Exit codes: ending.h. */
#include <signal.h>
#include <stdio.h>

#include "command_line.h"
#include "ending.h"
#include "plant.h"
#include "process.h"
#include "robot_file.h"

static volatile sig_atomic_t stop;

static void on_signal(int number) {
    stop = number;
}

static ending bad_input(const run *r) {
    fprintf(stderr, "%s\n", r->error);
    return ENDING_BAD_INPUT;
}

/* From the run folder to the controller's end. */
static ending run_with(plant *p, run *controller, const command_line *line, const robot_description *robot) {
    if (line->check) {
        return run_check(controller, line, robot) ? ENDING_DONE : bad_input(controller);
    }
    process_end_on_signals(on_signal);
    if (!run_open(controller, line, robot)) {
        return bad_input(controller);
    }
    plant_begin(p, &controller->link.bus.lcm, &stop);
    return ending_close(controller, run_decide(controller, &stop));
}

int main(int argc, char **argv) {
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_PAIR, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? ENDING_DONE : ENDING_BAD_INPUT;
    }
    static robot_description robot; /* both too large for a comfortable stack frame */
    static run controller;
    if (!robot_file_load(line.robot, line.packages, &robot)) {
        return ENDING_BAD_INPUT;
    }
    plant *p = plant_open(&robot, &line.settings);
    if (p == NULL) {
        return ENDING_BAD_INPUT;
    }
    line.lcm_url = PLANT_OWN_QUEUE;
    const ending how = run_with(p, &controller, &line, &robot);
    return plant_close(p) ? (int)how : ENDING_WENT_WRONG;
}
