#include "merge.h"

#include <stdio.h>
#include <string.h>

static void copy_name(char name[ROBOT_NAME_LENGTH], const char *from) {
    snprintf(name, ROBOT_NAME_LENGTH, "%.*s", ROBOT_NAME_LENGTH - 1, from);
}

/* What a joint that is held adds to its origin. */
static frame held_motion(const struct file_joint *joint) {
    if (joint->type == JOINT_REVOLUTE || joint->type == JOINT_CONTINUOUS) {
        return frame_about(joint->axis, joint->home);
    }
    return (frame){vector_scale(joint->axis, joint->home), matrix_identity()};
}

static void begin_body(const struct file_joint *joint, const struct file_link *link, const struct file_link *parent,
                       robot_body *body) {
    const frame origin = frame_multiply(&parent->pose, &joint->origin);
    copy_name(body->name, link->name);
    body->parent = parent->body;
    body->joint = frame_pose(&origin);
    vector_store(joint->axis, body->axis);
}

static bool place(struct reading *r, struct elements *e, struct file_link *link, robot_description *robot) {
    const struct file_joint *joint = &e->joints[link->joint];
    const struct file_link *parent = &e->links[joint->parent];
    if (joint->actuator < 0) {
        const frame origin = frame_multiply(&parent->pose, &joint->origin);
        const frame motion = held_motion(joint);
        link->body = parent->body;
        link->pose = frame_multiply(&origin, &motion);
        return true;
    }
    const struct file_actuator *actuator = &e->actuators[joint->actuator];
    link->body = joint->actuator + 1;
    link->pose = frame_identity();
    begin_body(joint, link, parent, &robot->bodies[link->body]);
    if (parent->body >= link->body) {
        fault(r, actuator->at, "joint", "stands before joint %.60s, which carries it; arms go from root to tip",
              e->joints[e->actuators[parent->body - 1].joint].name);
        return false;
    }
    if (parent->body > 0 && parent->body <= ROBOT_CRAWLERS) {
        fault(r, actuator->at, "joint", "hangs on the sprocket of a crawler; must hang on the base or on the arm");
        return false;
    }
    if (actuator->crawler && parent->body != 0) {
        fault(r, actuator->at, "joint", "hangs on the arm; a crawler must be fixed to the base");
        return false;
    }
    return true;
}

bool merge_links(struct reading *r, struct elements *e, const int order[MOST_LINKS], robot_description *robot) {
    struct file_link *root = &e->links[order[0]];
    root->body = 0;
    root->pose = frame_identity();
    copy_name(robot->bodies[0].name, root->name);
    robot->bodies[0].parent = -1;
    robot->bodies[0].joint = (robot_pose){{0, 0, 0}, {1, 0, 0, 0}};
    robot->bodies[0].axis[2] = 1;
    robot->num_actuators = e->num_actuators;
    robot->num_bodies = e->num_actuators + 1;
    bool good = true;
    for (int i = 1; i < e->num_links; i++) {
        good = place(r, e, &e->links[order[i]], robot) && good;
    }
    return good;
}

/* Inertia that `mass` at `at` has about `centre`: parallel axes. */
static matrix about(double mass, vector at, vector centre) {
    const vector from = vector_subtract(at, centre);
    const double square = vector_dot(from, from);
    matrix m;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            m.at[i][k] = mass * ((i == k ? square : 0) - vector_component(from, i) * vector_component(from, k));
        }
    }
    return m;
}

static void add_mass(const struct file_link *link, robot_body *body) {
    if (link->mass == 0) {
        return;
    }
    const frame pose = frame_multiply(&link->pose, &link->inertial);
    const matrix back = matrix_transpose(&pose.axes);
    const matrix half = matrix_multiply(&pose.axes, &link->inertia);
    const matrix turned = matrix_multiply(&half, &back);
    const double mass = body->mass + link->mass;
    const vector before = vector_of(body->centre);
    const vector moment = vector_add(vector_scale(before, body->mass), vector_scale(pose.origin, link->mass));
    const vector centre = {moment.x / mass, moment.y / mass, moment.z / mass};
    const matrix moved = about(body->mass, before, centre), added = about(link->mass, pose.origin, centre);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            body->inertia[i][k] += moved.at[i][k] + turned.at[i][k] + added.at[i][k];
        }
    }
    body->mass = mass;
    vector_store(centre, body->centre);
}

static void add_shape(struct reading *r, const struct file_link *link, const struct file_shape *from,
                      robot_description *robot) {
    if (robot->num_shapes >= ROBOT_MAX_SHAPES) {
        if (robot->num_shapes++ == ROBOT_MAX_SHAPES) {
            fault(r, from->at, NULL, "more than %d shapes, tips included", ROBOT_MAX_SHAPES);
        }
        return;
    }
    robot_shape *shape = &robot->shapes[robot->num_shapes++];
    const frame pose = frame_multiply(&link->pose, &from->pose);
    copy_name(shape->name, link->name);
    shape->body = link->body;
    shape->kind = from->kind;
    shape->pose = frame_pose(&pose);
    vector_store(from->half_size, shape->half_size);
}

static void add_support(struct reading *r, const struct elements *e, int index, robot_description *robot) {
    const struct file_support *from = &e->supports[index];
    const struct file_link *link = &e->links[from->link];
    robot_support *support = &robot->supports[robot->num_supports++];
    support->body = link->body;
    vector_store(frame_apply(&link->pose, from->point), support->point);
    support->radius = from->radius;
    if (index < e->num_tips) {
        const struct file_shape ball = {.at = from->at,
                                        .kind = ROBOT_SPHERE,
                                        .pose = {from->point, matrix_identity()},
                                        .half_size = {from->radius, from->radius, from->radius}};
        add_shape(r, link, &ball, robot);
    }
}

static void add_actuator(const struct elements *e, int index, robot_description *robot) {
    const struct file_actuator *from = &e->actuators[index];
    const struct file_joint *joint = &e->joints[from->joint];
    robot_actuator *actuator = &robot->actuators[index];
    copy_name(actuator->name, joint->name);
    actuator->effort = from->effort;
    actuator->speed = from->velocity;
    if (!from->crawler) {
        actuator->lower = from->lower;
        actuator->upper = from->upper;
        actuator->home = joint->home;
        return;
    }
    const struct file_link *parent = &e->links[joint->parent];
    const frame origin = frame_multiply(&parent->pose, &joint->origin);
    robot_crawler *crawler = &robot->crawlers[index];
    vector_store(frame_apply(&parent->pose, from->centre), crawler->centre);
    vector_store(matrix_apply(&origin.axes, joint->axis), crawler->axis);
    crawler->length = from->length;
    crawler->width = from->width;
    crawler->radius = from->radius;
}

void merge_parts(struct reading *r, struct elements *e, const int order[MOST_LINKS], robot_description *robot) {
    for (int i = 0; i < e->num_actuators; i++) {
        add_actuator(e, i, robot);
    }
    robot->num_tips = e->num_tips;
    for (int i = 0; i < e->num_supports; i++) {
        add_support(r, e, i, robot);
    }
    for (int i = 0; i < e->num_links; i++) {
        const struct file_link *link = &e->links[order[i]];
        add_mass(link, &robot->bodies[link->body]);
        for (int k = 0; k < link->num_shapes; k++) {
            add_shape(r, link, &link->shapes[k], robot);
        }
    }
    for (int b = 0; b < robot->num_bodies; b++) {
        const robot_body *body = &robot->bodies[b];
        if (!(body->mass > 0)) {
            fault(r, e->links[find_link(e, body->name)].at, NULL,
                  "has no mass, nor has what is fixed to it; needs <inertial> with <mass> above 0");
        }
    }
}
