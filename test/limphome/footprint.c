/* The formulas in capacity.h hold, whatever the capacities are: this does not compile otherwise. What learns
 * also keeps within its targets, Q-learning with the capacities of the paper's experiment. Prints the sizes. */
#include <stdio.h>

#include "limphome/controller.h"

/* The formula may say a little more than is needed, for padding, but nothing less. */
#define HOLDS(type, formula) _Static_assert(sizeof(type) <= (formula) && sizeof(type) + 24 > (formula), #type)

enum {
    S = LH_UNIT_SLOTS,
    A = LH_MAX_ACTUATORS,
    B = LH_PLANNED_ACTIONS,
    P = LH_MAX_SUPPORTS,
    K = LH_MAX_PLANNED,
    W = LH_MAX_WAYPOINTS,
    NETWORK = 8 + 4 * S * (2 * A + 4),
    SCRATCH = 4 * S * (3 * A + 6) + 4 * LH_MAX_UNITS * LH_COLUMN_SLOTS,
    Q_LEARNING = NETWORK + SCRATCH + 4 * LH_MAX_ACTIONS + 4 * A + 136,
    PLANNER_LEARNED = 22 * LH_MAX_SAMPLES + 20 * LH_MAX_POSTURES + 120,
    PLANNER = PLANNER_LEARNED + (52 + K) * B + 8 * A * P + 24 * A + 64 * LH_MAX_LINKS + 36 * P + 8 * W + 8 * K + 736,
    LEARNER = (Q_LEARNING > PLANNER ? Q_LEARNING : PLANNER) + 12,
    TASK = 20 * A + 64 * LH_MAX_LINKS + 20 * P + 8 * W + 192,
    MONITOR = 14 * A + 4 * LH_MAX_LINKS + 48 * LH_MAX_SHAPES + 228,
    CONTROLLER = LEARNER + TASK + MONITOR
};

HOLDS(lh_network, NETWORK);
HOLDS(lh_action_scratch, SCRATCH);
HOLDS(lh_q_learning, Q_LEARNING);
HOLDS(lh_planner_learned, PLANNER_LEARNED);
HOLDS(lh_planner, PLANNER);
HOLDS(lh_learner, LEARNER);
HOLDS(lh_task, TASK);
HOLDS(lh_monitor, MONITOR);
HOLDS(lh_controller, CONTROLLER);

#ifdef PAPER
_Static_assert(sizeof(lh_q_learning) - sizeof(lh_action_scratch) <= 4096, "state of Q-learning");
_Static_assert(sizeof(lh_action_scratch) <= 8192, "scratch of Q-learning");
#else
_Static_assert(sizeof(lh_controller) <= 65536, "all there is");
#endif

int main(void) {
    printf("lh_network %zu\nlh_q_learning without scratch %zu\nlh_action_scratch %zu\nlh_planner %zu\n",
           sizeof(lh_network), sizeof(lh_q_learning) - sizeof(lh_action_scratch), sizeof(lh_action_scratch),
           sizeof(lh_planner));
    printf("lh_planner_learned %zu\nlh_task %zu\nlh_monitor %zu\nlh_controller %zu\n", sizeof(lh_planner_learned),
           sizeof(lh_task), sizeof(lh_monitor), sizeof(lh_controller));
    return 0;
}
