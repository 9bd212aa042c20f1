#include "parts.h"

/* The link in whose frame a crawler's middle is given. */
static const struct file_link *carrier(const struct elements *e, const struct file_actuator *from) {
    return &e->links[from->joint < 0 ? from->link : e->joints[from->joint].parent];
}

/* Of a sprocket, in the frame of the base; of one that has no joint: from the right crawler to the left one. */
static vector sprocket_axis(const struct elements *e, const struct file_actuator *from,
                            const robot_crawler crawlers[ROBOT_CRAWLERS]) {
    if (from->joint >= 0) {
        const struct file_joint *joint = &e->joints[from->joint];
        const vector axis = matrix_apply(&joint->origin.axes, joint->axis);
        return matrix_apply(&carrier(e, from)->pose.axes, axis);
    }
    const double x = crawlers[0].centre[0] - crawlers[1].centre[0], y = crawlers[0].centre[1] - crawlers[1].centre[1];
    return x == 0 && y == 0 ? (vector){0, 1, 0} : vector_unit((vector){x, y, 0});
}

void parts_crawlers(const struct elements *e, robot_description *robot) {
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        const struct file_actuator *from = &e->actuators[c];
        robot_crawler *crawler = &robot->crawlers[c];
        vector_store(frame_apply(&carrier(e, from)->pose, from->centre), crawler->centre);
        crawler->length = from->length;
        crawler->width = from->width;
        crawler->radius = from->radius;
    }
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        vector_store(sprocket_axis(e, &e->actuators[c], robot->crawlers), robot->crawlers[c].axis);
    }
}

void parts_actuators(const struct elements *e, robot_description *robot) {
    for (int a = 0; a < e->num_actuators; a++) {
        const struct file_actuator *from = &e->actuators[a];
        robot_actuator *actuator = &robot->actuators[a];
        const char *name = from->joint >= 0 ? e->joints[from->joint].name : robot->bodies[a + 1].name;
        short_name(actuator->name, name);
        actuator->effort = from->effort;
        actuator->speed = from->velocity;
        if (!from->crawler) {
            actuator->lower = from->lower;
            actuator->upper = from->upper;
            actuator->home = e->joints[from->joint].home;
        }
    }
}

static void add_ends_of_belts(robot_description *robot) {
    static const double ends[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}; /* forward, left */
    for (int i = 0; i < 4; i++) {
        const robot_crawler *c = &robot->crawlers[ends[i][1] > 0 ? 0 : 1];
        robot->supports[robot->num_supports++] =
            (robot_support){.point = {c->centre[0] + ends[i][0] * (c->length / 2 - c->radius),
                                      c->centre[1] + ends[i][1] * c->width / 2, c->centre[2] - c->radius}};
    }
}

void parts_supports(struct reading *r, const struct elements *e, robot_description *robot) {
    robot->num_tips = e->num_tips;
    for (int i = 0; i < e->num_supports; i++) {
        const struct file_support *from = &e->supports[i];
        const struct file_link *link = &e->links[from->link];
        robot_support *support = &robot->supports[robot->num_supports++];
        support->body = link->body;
        support->radius = from->radius;
        vector_store(frame_apply(&link->pose, from->point), support->point);
        if (is_far(support->point)) {
            fault(r, from->at, "xyz", "is more than %g m from its body", MOST_METRES);
        }
    }
    if (robot->num_supports == robot->num_tips) {
        add_ends_of_belts(robot);
    }
}
