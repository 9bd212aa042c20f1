#include "sprocket.h"

#include <stdio.h>
#include <string.h>

/* Share of the base's mass that becomes the body of a sprocket. */
#define SHARE 0.001

/* Unless it is given, the drive train resists turning like this share of the robot's mass on the belt: that of the
 * robots in config/ is 3 to 13 %. */
#define CARRIED 0.05

static void make_body(const robot_crawler *crawler, int index, double mass, double inertia, robot_body *body) {
    static const char *const names[ROBOT_CRAWLERS] = {"left_sprocket", "right_sprocket"};
    snprintf(body->name, sizeof body->name, "%s", names[index]);
    body->parent = 0;
    memcpy(body->joint.position, crawler->centre, sizeof body->joint.position);
    body->joint.rotation[0] = 1;
    memcpy(body->axis, crawler->axis, sizeof body->axis);
    body->mass = mass;
    body->inertia[0][0] = body->inertia[2][2] = inertia / 2;
    body->inertia[1][1] = inertia;
}

void sprockets_make(struct reading *r, const struct elements *e, robot_description *robot) {
    double total = 0;
    for (int b = 0; b < robot->num_bodies; b++) {
        total += robot->bodies[b].mass;
    }
    const double mass = SHARE * robot->bodies[0].mass;
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        const struct file_actuator *from = &e->actuators[c];
        if (from->joint >= 0) {
            continue;
        }
        double inertia = from->inertia;
        if (!(inertia > 0)) {
            inertia = CARRIED * total * from->radius * from->radius;
            remark(r, from->at, NULL,
                   "the drive train is given an inertia of %.3g kg m^2 about the sprocket, which inertia here would "
                   "change",
                   inertia);
        }
        make_body(&robot->crawlers[c], c, mass, inertia, &robot->bodies[c + 1]);
        robot->bodies[0].mass -= mass;
    }
}
