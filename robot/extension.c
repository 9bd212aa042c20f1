#include <math.h>
#include <string.h>

#include "elements.h"
#include "hold.h"

#define PI 3.14159265358979323846
#define LEAST_RANGE 1e-3            /* [rad] */
#define ONCE_ROUND (2 * PI * 1.001) /* and what rounding adds [rad] */

/* Attributes that are none of `known`, a list with NULL at its end: most likely a misspelt one. */
static void refuse_unknown_attributes(struct reading *r, const struct xml_element *at, const char *const *known) {
    for (const char **a = at->attributes; a[0] != NULL; a += 2) {
        if (!xml_is_one_of(a[0], known)) {
            fault(r, at, a[0], "unknown attribute");
        }
    }
}

/* The joint an actuator is of, which no other is, or -1 with a fault. */
static int read_own_joint(struct reading *r, const struct elements *e, const struct xml_element *at) {
    const int joint = read_known(r, at, "joint", e, find_joint);
    if (joint >= 0 && e->joints[joint].actuator >= 0) {
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
    read_positive(r, at, "effort", false, MOST_EFFORT, &actuator->effort);
    read_positive(r, at, "velocity", false, MOST_VELOCITY, &actuator->velocity);
    const struct xml_element *limit = xml_child(joint->at, "limit");
    const struct xml_element *lacking = limit != NULL ? limit : joint->at;
    if (!effort && !(actuator->effort > 0 && actuator->effort <= MOST_EFFORT)) {
        fault(r, lacking, limit != NULL ? "effort" : NULL,
              "needs <limit> with effort above 0 and at most %g, the largest torque [N m], here or in <%s>",
              MOST_EFFORT, at->name);
    }
    if (!velocity && !(actuator->velocity > 0 && actuator->velocity <= MOST_VELOCITY)) {
        fault(r, lacking, limit != NULL ? "velocity" : NULL,
              "needs <limit> with velocity above 0 and at most %g, the largest rate [rad/s], here or in <%s>",
              MOST_VELOCITY, at->name);
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

static void read_belt(struct reading *r, const struct xml_element *at, struct file_actuator *c) {
    read_vector(r, at, "xyz", true, MOST_METRES, &c->centre);
    const bool sized = read_positive(r, at, "length", true, MOST_METRES, &c->length);
    read_positive(r, at, "width", true, MOST_METRES, &c->width);
    if (read_positive(r, at, "radius", true, MOST_METRES, &c->radius) && sized && c->length < 2 * c->radius) {
        fault(r, at, "length", "must be at least twice the radius of %g m", c->radius);
    }
}

/* A crawler that the file has no joint for, fixed to a link. */
static void read_free_crawler(struct reading *r, struct elements *e, const struct xml_element *at,
                              struct file_actuator *c) {
    static const char *const known[] = {"link",   "xyz",      "length",  "width", "radius",
                                        "effort", "velocity", "inertia", NULL};
    refuse_unknown_attributes(r, at, known);
    c->link = read_known(r, at, "link", e, find_link);
    read_belt(r, at, c);
    read_positive(r, at, "effort", true, MOST_EFFORT, &c->effort);
    read_positive(r, at, "velocity", true, MOST_VELOCITY, &c->velocity);
    read_positive(r, at, "inertia", false, MOST_KILOGRAMS, &c->inertia);
}

static void read_crawler(struct reading *r, struct elements *e, const struct xml_element *at) {
    static const char *const known[] = {"joint", "xyz", "length", "width", "radius", "effort", "velocity", NULL};
    struct file_actuator *c = add_actuator(r, e, at);
    if (c == NULL) {
        return;
    }
    c->crawler = true;
    if (xml_attribute(at, "link") != NULL && xml_attribute(at, "joint") == NULL) {
        read_free_crawler(r, e, at, c);
        return;
    }
    refuse_unknown_attributes(r, at, known);
    const int joint = read_own_joint(r, e, at);
    read_belt(r, at, c);
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

/* Limits that are more than once round: degrees, most likely. */
static void refuse_turns(struct reading *r, const struct xml_element *given, const struct file_actuator *arm) {
    const double degree = PI / 180;
    const bool whole = rint(arm->lower) == arm->lower && rint(arm->upper) == arm->upper;
    const char *key = arm->upper > ONCE_ROUND ? "upper" : "lower";
    if (whole && fabs(arm->lower) <= 360 && fabs(arm->upper) <= 360) {
        fault(r, given, key, "lower %g and upper %g look like degrees; must be in radians: %.4g and %.4g", arm->lower,
              arm->upper, arm->lower * degree, arm->upper * degree);
    } else {
        fault(r, given, key, "lower %g and upper %g must lie within once round, -6.283 to 6.283 rad", arm->lower,
              arm->upper);
    }
}

/* Limits of an arm joint: the extension's, else the joint's; a continuous one may turn once round. */
static void read_range(struct reading *r, const struct xml_element *at, const struct file_joint *joint,
                       struct file_actuator *arm) {
    const bool continuous = joint->type == JOINT_CONTINUOUS;
    arm->lower = continuous ? -PI : joint->lower;
    arm->upper = continuous ? PI : joint->upper;
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
    if (!(arm->upper - arm->lower >= LEAST_RANGE)) {
        fault(r, given, lower ? "lower" : "upper", "lower %g must be below upper %g [rad]", arm->lower, arm->upper);
    } else if (arm->lower < -ONCE_ROUND || arm->upper > ONCE_ROUND) {
        refuse_turns(r, given, arm);
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
    const int joint = read_own_joint(r, e, at);
    if (joint < 0) {
        return;
    }
    struct file_joint *moved = &e->joints[joint];
    arm->joint = joint;
    moved->actuator = e->num_actuators - 1;
    moved->home = home;
    if (moved->mimic != NULL) {
        fault(r, moved->mimic, "joint",
              "an <arm> joint that follows another cannot be driven by itself; leave it out of <limphome>, "
              "and it is held, or remove <mimic>");
    }
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
    *support = (struct file_support){.at = at, .link = read_known(r, at, "link", e, find_link)};
    read_vector(r, at, "xyz", true, MOST_METRES, &support->point);
    if (tip) {
        read_positive(r, at, "radius", true, MOST_METRES, &support->radius);
        e->num_tips++;
    } else {
        read_not_negative(r, at, "radius", false, MOST_METRES, &support->radius);
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
    } else if (e->num_supports > e->num_tips && e->num_supports < 3) {
        fault(r, e->extension, NULL,
              "has %d <tip> and %d <support>; must have three in all to stand on, or no <support>: "
              "then they follow from the crawlers",
              e->num_tips, e->num_supports - e->num_tips);
    } else if (e->num_supports == e->num_tips && e->num_tips + 4 > ROBOT_MAX_SUPPORTS) {
        fault(r, e->extension, NULL, "has %d <tip>; must be %d at most, as the crawlers add four", e->num_tips,
              ROBOT_MAX_SUPPORTS - 4);
    }
}

/* What may stand in <limphome>, with the attributes of what is read elsewhere. */
static void check_names(struct reading *r, const struct xml_element *extension) {
    static const char *const names[] = {"crawler", "arm", "tip", "support", "hold", "inertial", "no_contact", NULL};
    static const char *const own[] = {"self_contact", NULL}, *const hold[] = {"joint", "home", NULL},
                             *const no_contact[] = {"link1", "link2", NULL},
                             *const inertial[] = {"link", "mass", "xyz", "size", NULL};
    refuse_unknown_attributes(r, extension, own);
    for (const struct xml_element *at = extension->first; at != NULL; at = at->next) {
        if (!xml_is_one_of(at->name, names)) {
            fault(r, at, NULL,
                  "unknown inside <limphome>; known are <crawler>, <arm>, <tip>, <support>, <hold>, <inertial>, "
                  "<no_contact>");
        } else if (strcmp(at->name, "hold") == 0) {
            refuse_unknown_attributes(r, at, hold);
        } else if (strcmp(at->name, "no_contact") == 0) {
            refuse_unknown_attributes(r, at, no_contact);
        } else if (strcmp(at->name, "inertial") == 0) {
            refuse_unknown_attributes(r, at, inertial);
        }
    }
}

/* What it gives has been taken for that of the link; here only whether there is such a link, and one of it. */
static void check_inertial(struct reading *r, struct elements *e, const struct xml_element *at) {
    const int link = read_known(r, at, "link", e, find_link);
    if (link >= 0 && e->links[link].inertia_at != at) {
        fault(r, at, "link", "is given twice, first in line %lu; once is allowed", e->links[link].inertia_at->line);
    }
}

void extension_read(struct reading *r, struct elements *e) {
    e->extension = read_child(r, e->robot, "limphome");
    if (e->extension == NULL) {
        fault(r, e->robot, NULL, "needs <limphome>, which names crawlers, arm joints and tip");
        return;
    }
    check_names(r, e->extension);
    read_each(r, e, "crawler", read_crawler);
    read_each(r, e, "arm", read_arm);
    read_each(r, e, "tip", read_support);
    read_each(r, e, "support", read_support);
    read_each(r, e, "inertial", check_inertial);
    check_counts(r, e);
    hold_joints(r, e);
}
