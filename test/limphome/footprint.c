/* The formulas in capacity.h hold, whatever the capacities are: this does not compile otherwise. With the capacities of
 * the paper's experiment the learner also keeps within its targets. Prints the sizes. */
#include <stdio.h>

#include "limphome/controller.h"

/* The formula may say a little more than is needed, for padding, but nothing less. */
#define HOLDS(type, formula) _Static_assert(sizeof(type) <= (formula) && sizeof(type) + 16 > (formula), #type)

enum {
    S = LH_UNIT_SLOTS,
    A = LH_MAX_ACTUATORS,
    NETWORK = 8 + 4 * S * (2 * A + 4),
    SCRATCH = 4 * S * (3 * A + 6) + 4 * LH_MAX_UNITS * LH_COLUMN_SLOTS,
    LEARNER = NETWORK + SCRATCH + 4 * LH_MAX_ACTIONS + 4 * A + 144,
    TASK = 20 * A + 64 * LH_MAX_LINKS + 20 * LH_MAX_SUPPORTS + 8 * LH_MAX_WAYPOINTS + 192,
    CONTROLLER = LEARNER + TASK
};

HOLDS(lh_network, NETWORK);
HOLDS(lh_action_scratch, SCRATCH);
HOLDS(lh_learner, LEARNER);
HOLDS(lh_task, TASK);
HOLDS(lh_controller, CONTROLLER);

#ifdef PAPER
_Static_assert(sizeof(lh_learner) - sizeof(lh_action_scratch) <= 4096, "state of the learner");
_Static_assert(sizeof(lh_action_scratch) <= 8192, "scratch of the learner");
#endif

int main(void) {
    printf("lh_network %zu\nlh_learner without scratch %zu\nlh_action_scratch %zu\nlh_task %zu\nlh_controller %zu\n",
           sizeof(lh_network), sizeof(lh_learner) - sizeof(lh_action_scratch), sizeof(lh_action_scratch),
           sizeof(lh_task), sizeof(lh_controller));
    return 0;
}
