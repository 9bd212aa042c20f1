#include "robot_overlap.h"

#include <math.h>

#include "robot_solid.h"

static const double least_depth = 1e-6; /* less is rounding of what stands in the file [m] */

/* What lies in a body's frame, seen from that of the base, with all joints at home. */
static robot_solid at_home(const robot_description *robot, int body, robot_solid solid) {
    for (; body > 0; body = robot->bodies[body].parent) {
        const robot_body *b = &robot->bodies[body];
        const double half = 0.5 * robot->actuators[body - 1].home;
        const robot_pose turned = {
            .rotation = {cos(half), sin(half) * b->axis[0], sin(half) * b->axis[1], sin(half) * b->axis[2]}};
        solid = robot_solid_placed(&solid, &turned);
        solid = robot_solid_placed(&solid, &b->joint);
    }
    return solid;
}

int robot_overlaps_at_home(const robot_description *robot, robot_overlap *overlaps, int most) {
    robot_solid solids[ROBOT_MAX_SHAPES + ROBOT_CRAWLERS];
    int body[ROBOT_MAX_SHAPES + ROBOT_CRAWLERS] = {0};
    const int count = robot->num_shapes + ROBOT_CRAWLERS;
    for (int i = 0; i < count; i++) {
        const bool belt = i >= robot->num_shapes;
        body[i] = belt ? 0 : robot->shapes[i].body;
        solids[i] = belt ? robot_solid_of_belt(&robot->crawlers[i - robot->num_shapes])
                         : at_home(robot, body[i], robot_solid_of_shape(&robot->shapes[i]));
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
