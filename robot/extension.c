#include <math.h>
#include <string.h>

#include "elements.h"

/* Attributes that are none of `known`, a list with NULL at its end: most likely a misspelt one. */
static void refuse_unknown_attributes(struct reading *r, const struct xml_element *at, const char *const *known) {
    for (const char **a = at->attributes; a[0] != NULL; a += 2) {
        bool found = false;
        for (const char *const *k = known; *k != NULL && !found; k++) {
            found = strcmp(a[0], *k) == 0;
        }
        if (!found) {
            fault(r, at, a[0], "unknown attribute");
        }
    }
}

static int read_link_name(struct reading *r, const struct elements *e, const struct xml_element *at) {
    const char *name = read_name(r, at, "link");
    const int link = find_link(e, name);
    if (link < 0 && name[0] != '\0') {
        fault(r, at, "link", "there is no such link");
    }
    return link;
}

/* The joint an actuator is of, which no other is, or -1 with a fault. */
static int read_joint_name(struct reading *r, const struct elements *e, const struct xml_element *at) {
    const char *name = read_name(r, at, "joint");
    const int joint = find_joint(e, name);
    if (joint < 0) {
        if (name[0] != '\0') {
            fault(r, at, "joint", "there is no such joint");
        }
        return -1;
    }
    if (e->joints[joint].actuator >= 0) {
        fault(r, at, "joint", "is an actuator already (line %lu)", e->actuators[e->joints[joint].actuator].at->line);
        return -1;
    }
    return joint;
}

/* What the drive can do: the extension's word goes before the joint's, where tools often write 0. */
static void read_drive(struct reading *r, const struct xml_element *at, const struct file_joint *joint,
                       struct file_actuator *actuator) {
    actuator->effort = joint->effort;
    actuator->velocity = joint->velocity;
    const bool effort = xml_attribute(at, "effort") != NULL, velocity = xml_attribute(at, "velocity") != NULL;
    read_positive(r, at, "effort", false, &actuator->effort);
    read_positive(r, at, "velocity", false, &actuator->velocity);
    const struct xml_element *limit = xml_child(joint->at, "limit");
    const struct xml_element *lacking = limit != NULL ? limit : joint->at;
    if (!effort && !(actuator->effort > 0)) {
        fault(r, lacking, limit != NULL ? "effort" : NULL,
              "needs <limit> with effort above 0, the largest torque [N m], here or in <%s>", at->name);
    }
    if (!velocity && !(actuator->velocity > 0)) {
        fault(r, lacking, limit != NULL ? "velocity" : NULL,
              "needs <limit> with velocity above 0, the largest rate [rad/s], here or in <%s>", at->name);
    }
}

static struct file_actuator *add_actuator(struct reading *r, struct elements *e, const struct xml_element *at) {
    if (e->num_actuators == ROBOT_MAX_ACTUATORS) {
        fault(r, at, NULL, "more than %d actuators, crawlers included", ROBOT_MAX_ACTUATORS);
        return NULL;
    }
    struct file_actuator *actuator = &e->actuators[e->num_actuators++];
    *actuator = (struct file_actuator){.at = at, .joint = -1};
    return actuator;
}

static void read_crawler(struct reading *r, struct elements *e, const struct xml_element *at) {
    static const char *const known[] = {"joint", "xyz", "length", "width", "radius", "effort", "velocity", NULL};
    refuse_unknown_attributes(r, at, known);
    struct file_actuator *c = add_actuator(r, e, at);
    if (c == NULL) {
        return;
    }
    c->crawler = true;
    const int joint = read_joint_name(r, e, at);
    read_vector(r, at, "xyz", true, &c->centre);
    const bool sized = read_positive(r, at, "length", true, &c->length);
    read_positive(r, at, "width", true, &c->width);
    if (read_positive(r, at, "radius", true, &c->radius) && sized && c->length < 2 * c->radius) {
        fault(r, at, "length", "must be at least twice the radius of %g m", c->radius);
    }
    if (joint < 0) {
        return;
    }
    c->joint = joint;
    e->joints[joint].actuator = e->num_actuators - 1;
    if (e->joints[joint].type != JOINT_CONTINUOUS) {
        fault(r, e->joints[joint].at, "type", "the joint of a crawler's sprocket must be continuous");
        return;
    }
    read_drive(r, at, &e->joints[joint], c);
}

/* Limits of an arm joint: the extension's, else the joint's; a continuous one may turn once round. */
static void read_range(struct reading *r, const struct xml_element *at, const struct file_joint *joint,
                       struct file_actuator *arm) {
    const double pi = 3.14159265358979323846;
    const bool continuous = joint->type == JOINT_CONTINUOUS;
    arm->lower = continuous ? -pi : joint->lower;
    arm->upper = continuous ? pi : joint->upper;
    const bool lower = read_numbers(r, at, "lower", false, &arm->lower, 1);
    const bool upper = read_numbers(r, at, "upper", false, &arm->upper, 1);
    const struct xml_element *limit = xml_child(joint->at, "limit");
    const struct xml_element *given = lower || upper || limit == NULL ? at : limit;
    if (continuous && !(lower && upper)) {
        remark(r, at, "joint", "is continuous; limited to %.4g to %.4g rad, which lower and upper here would change",
               arm->lower, arm->upper);
    } else if (!continuous && limit == NULL && !(lower && upper)) {
        fault(r, joint->at, NULL, "needs <limit> with lower and upper [rad]");
        return;
    }
    if (!(arm->lower < arm->upper)) {
        fault(r, given, lower ? "lower" : "upper", "lower %g must be below upper %g [rad]", arm->lower, arm->upper);
    }
}

static void read_arm(struct reading *r, struct elements *e, const struct xml_element *at) {
    static const char *const known[] = {"joint", "home", "effort", "velocity", "lower", "upper", NULL};
    refuse_unknown_attributes(r, at, known);
    struct file_actuator *arm = add_actuator(r, e, at);
    if (arm == NULL) {
        return;
    }
    double home = 0;
    const bool placed = read_numbers(r, at, "home", true, &home, 1);
    const int joint = read_joint_name(r, e, at);
    if (joint < 0) {
        return;
    }
    struct file_joint *moved = &e->joints[joint];
    arm->joint = joint;
    moved->actuator = e->num_actuators - 1;
    moved->home = home;
    if (moved->type != JOINT_REVOLUTE && moved->type != JOINT_CONTINUOUS) {
        fault(r, moved->at, "type", "the joint of an <arm> must be revolute or continuous");
        return;
    }
    read_drive(r, at, moved, arm);
    read_range(r, at, moved, arm);
    if (placed && arm->lower < arm->upper && !(home >= arm->lower && home <= arm->upper)) {
        fault(r, at, "home", "must lie within the limits of joint %.60s, %g to %g rad", moved->name, arm->lower,
              arm->upper);
    }
}

static void read_support(struct reading *r, struct elements *e, const struct xml_element *at) {
    static const char *const known[] = {"link", "xyz", "radius", NULL};
    const bool tip = strcmp(at->name, "tip") == 0;
    refuse_unknown_attributes(r, at, known);
    if (e->num_supports == ROBOT_MAX_SUPPORTS) {
        fault(r, at, NULL, "more than %d tips and supports", ROBOT_MAX_SUPPORTS);
        return;
    }
    struct file_support *support = &e->supports[e->num_supports++];
    *support = (struct file_support){.at = at, .link = read_link_name(r, e, at)};
    read_vector(r, at, "xyz", true, &support->point);
    if (tip) {
        read_positive(r, at, "radius", true, &support->radius);
        e->num_tips++;
    } else {
        read_not_negative(r, at, "radius", false, &support->radius);
    }
}

/* Each child of that name, in the order of the file. */
static void read_each(struct reading *r, struct elements *e, const char *name,
                      void (*read)(struct reading *, struct elements *, const struct xml_element *)) {
    for (const struct xml_element *at = xml_child(e->extension, name); at != NULL; at = xml_again(at)) {
        read(r, e, at);
    }
}

static void check_counts(struct reading *r, const struct elements *e) {
    int crawlers = 0;
    while (crawlers < e->num_actuators && e->actuators[crawlers].crawler) {
        crawlers++;
    }
    if (crawlers != ROBOT_CRAWLERS) {
        fault(r, e->extension, NULL, "has %d <crawler>; must have two, left and then right", crawlers);
    }
    if (e->num_actuators == crawlers) {
        fault(r, e->extension, NULL, "has no <arm>; must have at least one, from root to tip");
    }
    if (e->num_tips == 0) {
        fault(r, e->extension, NULL, "has no <tip>; must have at least one, the end of the arm");
    }
}

void extension_read(struct reading *r, struct elements *e) {
    static const char *const known[] = {"crawler", "arm", "tip", "support"};
    e->extension = read_child(r, e->robot, "limphome");
    if (e->extension == NULL) {
        fault(r, e->robot, NULL, "needs <limphome>, which names crawlers, arm joints and tip");
        return;
    }
    for (const struct xml_element *at = e->extension->first; at != NULL; at = at->next) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof known[0] && !found; i++) {
            found = strcmp(at->name, known[i]) == 0;
        }
        if (!found) {
            fault(r, at, NULL, "unknown inside <limphome>; known are <crawler>, <arm>, <tip>, <support>");
        }
    }
    read_each(r, e, "crawler", read_crawler);
    read_each(r, e, "arm", read_arm);
    read_each(r, e, "tip", read_support);
    read_each(r, e, "support", read_support);
    check_counts(r, e);
}
