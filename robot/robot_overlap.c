#include "robot_overlap.h"

#include "robot_solid.h"

static const double least_depth = 1e-6; /* less is rounding of what stands in the file [m] */

int robot_overlaps_at_home(const robot_description *robot, robot_overlap *overlaps, int most) {
    robot_solid solids[ROBOT_MAX_SHAPES + ROBOT_CRAWLERS];
    int body[ROBOT_MAX_SHAPES + ROBOT_CRAWLERS] = {0};
    const int count = robot->num_shapes + ROBOT_CRAWLERS;
    for (int i = 0; i < count; i++) {
        const bool belt = i >= robot->num_shapes;
        body[i] = belt ? 0 : robot->shapes[i].body;
        solids[i] = belt ? robot_solid_of_belt(&robot->crawlers[i - robot->num_shapes])
                         : robot_solid_at_home(robot, &robot->shapes[i]);
    }
    int found = 0;
    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count; j++) {
            if (!robot->may_meet[body[i]][body[j]]) {
                continue;
            }
            const double depth = -robot_solid_gap(&solids[i], &solids[j]).distance;
            if (depth > least_depth && found < most) {
                overlaps[found] = (robot_overlap){i, j, depth};
            }
            found += depth > least_depth;
        }
    }
    return found;
}
