#include "elements.h"

#include <math.h>
#include <string.h>

/* [kg m^2] */
#define MOST_INERTIA 1e9

int find_link(const struct elements *e, const char *name) {
    for (int i = 0; i < e->num_links; i++) {
        if (strcmp(e->links[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

int find_joint(const struct elements *e, const char *name) {
    for (int i = 0; i < e->num_joints; i++) {
        if (strcmp(e->joints[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

int read_known(struct reading *r, const struct xml_element *at, const char *key, const struct elements *e,
               int (*find)(const struct elements *, const char *)) {
    const char *name = read_name(r, at, key);
    const int index = find(e, name);
    if (index < 0 && name[0] != '\0') {
        fault(r, at, key, find == find_link ? "there is no such link" : "there is no such joint");
    }
    return index;
}

bool is_sprocket(int body) {
    return body > 0 && body <= ROBOT_CRAWLERS;
}

bool is_far(const double point[3]) {
    return vector_norm(vector_of(point)) > MOST_METRES;
}

static void tell_unknown(struct reading *r, const struct xml_element *at, const char *const *known) {
    for (const struct xml_element *child = at->first; child != NULL; child = child->next) {
        if (!xml_is_one_of(child->name, known)) {
            remark(r, child, NULL, "is no element of URDF; passed over");
        }
    }
}

static void read_inertia(struct reading *r, const struct xml_element *at, matrix *inertia) {
    static const char *const keys[3][3] = {{"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}};
    for (int i = 0; i < 3; i++) {
        for (int k = i; k < 3; k++) {
            double value = 0;
            if (read_numbers(r, at, keys[i][k], i == k, &value, 1) && fabs(value) > MOST_INERTIA) {
                fault(r, at, keys[i][k], "must be of at most %g", MOST_INERTIA);
            }
            inertia->at[i][k] = inertia->at[k][i] = value;
        }
    }
}

/* From an element on, the first of its name that names the link by `key`, or NULL. */
static const struct xml_element *naming(const struct xml_element *at, const char *key, const char *link) {
    for (; at != NULL; at = xml_again(at)) {
        const char *named = xml_attribute(at, key);
        if (named != NULL && strcmp(named, link) == 0) {
            return at;
        }
    }
    return NULL;
}

/* The first element of that name in <limphome>, or NULL. */
static const struct xml_element *in_extension(const struct elements *e, const char *element) {
    const struct xml_element *extension = xml_child(e->robot, "limphome");
    return extension != NULL ? xml_child(extension, element) : NULL;
}

/* <inertial> of the extension, in place of the link's own: that of a box of even density. */
static void read_box_inertial(struct reading *r, const struct xml_element *at, struct file_link *link) {
    vector size = {1, 1, 1};
    link->inertial = frame_identity();
    link->mass_at = link->inertia_at = at;
    read_positive(r, at, "mass", true, MOST_KILOGRAMS, &link->mass);
    read_vector(r, at, "xyz", false, MOST_METRES, &link->inertial.origin);
    if (read_vector(r, at, "size", true, MOST_METRES, &size) && !(size.x > 0 && size.y > 0 && size.z > 0)) {
        fault(r, at, "size", "must be three lengths above 0");
    }
    const double x = size.x * size.x, y = size.y * size.y, z = size.z * size.z, share = link->mass / 12;
    link->inertia = (matrix){{{share * (y + z), 0, 0}, {0, share * (x + z), 0}, {0, 0, share * (x + y)}}};
}

static void read_inertial(struct reading *r, const struct elements *e, struct file_link *link) {
    const struct xml_element *given = naming(in_extension(e, "inertial"), "link", link->name);
    if (given != NULL) {
        read_box_inertial(r, given, link);
        return;
    }
    link->inertial = frame_identity();
    const struct xml_element *inertial = read_child(r, link->at, "inertial");
    if (inertial == NULL) {
        return;
    }
    link->inertial = read_origin(r, inertial);
    link->mass_at = read_child(r, inertial, "mass");
    link->inertia_at = read_child(r, inertial, "inertia");
    if (link->mass_at == NULL) {
        fault(r, inertial, NULL, "needs <mass>");
    } else {
        read_not_negative(r, link->mass_at, "value", true, MOST_KILOGRAMS, &link->mass);
    }
    if (link->inertia_at != NULL) {
        read_inertia(r, link->inertia_at, &link->inertia);
    } else if (link->mass > 0) {
        fault(r, inertial, NULL, "needs <inertia>");
    }
}

/* Whether the extension leaves the shapes of a link out: they are not looked at, nor are their meshes. */
static bool touches_nothing(const struct elements *e, const char *name) {
    const struct xml_element *at = naming(in_extension(e, "no_contact"), "link1", name);
    while (at != NULL && xml_attribute(at, "link2") != NULL) {
        at = naming(xml_again(at), "link1", name);
    }
    return at != NULL;
}

static void read_link(struct reading *r, const struct elements *e, struct file_link *link) {
    static const char *const known[] = {"inertial", "visual", "collision", "contact", "sensor", "gazebo", NULL};
    link->name = read_name(r, link->at, "name");
    const int same = link->name[0] != '\0' ? find_link(e, link->name) : -1;
    if (same >= 0 && &e->links[same] != link) {
        fault(r, link->at, NULL, "is given twice, first in line %lu; names must differ", e->links[same].at->line);
    }
    read_inertial(r, e, link);
    if (!touches_nothing(e, link->name)) {
        shapes_read(r, link);
    }
    tell_unknown(r, link->at, known);
}

static void read_type(struct reading *r, struct file_joint *joint) {
    static const char *const types[] = {"fixed", "revolute", "continuous", "prismatic", "floating", "planar"};
    const char *type = xml_attribute(joint->at, "type");
    for (int i = 0; i < (int)(sizeof types / sizeof types[0]) && type != NULL; i++) {
        if (strcmp(type, types[i]) == 0) {
            joint->type = (enum joint_type)i;
            return;
        }
    }
    fault(r, joint->at, type == NULL ? NULL : "type",
          "needs type=\"...\", one of fixed, revolute, continuous, prismatic, floating, planar");
}

static bool has_axis(const struct file_joint *joint) {
    return joint->type == JOINT_REVOLUTE || joint->type == JOINT_CONTINUOUS || joint->type == JOINT_PRISMATIC;
}

static void read_axis(struct reading *r, struct file_joint *joint) {
    const struct xml_element *at = read_child(r, joint->at, "axis");
    vector axis = {1, 0, 0}; /* URDF's default */
    if (at != NULL && !read_vector(r, at, "xyz", true, 1e6, &axis)) {
        return;
    }
    if (!has_axis(joint)) {
        return; /* tools write axes that mean nothing, also zero */
    }
    if (vector_norm(axis) < 1e-6) {
        fault(r, at, "xyz", "has no direction; must not be zero");
        return;
    }
    joint->axis = vector_unit(axis);
}

static void read_limit(struct reading *r, struct file_joint *joint) {
    const struct xml_element *limit = read_child(r, joint->at, "limit");
    if (limit == NULL) {
        return;
    }
    read_numbers(r, limit, "lower", false, &joint->lower, 1);
    read_numbers(r, limit, "upper", false, &joint->upper, 1);
    read_numbers(r, limit, "effort", false, &joint->effort, 1);
    read_numbers(r, limit, "velocity", false, &joint->velocity, 1);
}

static const char *read_end(struct reading *r, const struct xml_element *joint, const char *end) {
    const struct xml_element *at = read_child(r, joint, end);
    if (at == NULL) {
        fault(r, joint, NULL, "needs <%s link=\"...\"/>", end);
        return "";
    }
    return read_name(r, at, "link");
}

static void read_joint(struct reading *r, const struct elements *e, struct file_joint *joint) {
    static const char *const known[] = {"origin",   "parent",      "child", "axis",   "limit",
                                        "dynamics", "calibration", "mimic", "gazebo", "safety_controller",
                                        "sensor",   NULL};
    joint->name = read_name(r, joint->at, "name");
    const int same = joint->name[0] != '\0' ? find_joint(e, joint->name) : -1;
    if (same >= 0 && &e->joints[same] != joint) {
        fault(r, joint->at, NULL, "is given twice, first in line %lu; names must differ", e->joints[same].at->line);
    }
    joint->actuator = -1;
    read_type(r, joint);
    joint->parent_name = read_end(r, joint->at, "parent");
    joint->child_name = read_end(r, joint->at, "child");
    joint->origin = read_origin(r, joint->at);
    read_axis(r, joint);
    read_limit(r, joint);
    joint->multiplier = 1;
    joint->mimic = read_child(r, joint->at, "mimic");
    if (joint->mimic != NULL) {
        read_numbers(r, joint->mimic, "multiplier", false, &joint->multiplier, 1);
        read_numbers(r, joint->mimic, "offset", false, &joint->offset, 1);
    }
    tell_unknown(r, joint->at, known);
}

/* How many children of that name there are, at most `most`; more is a fault. */
static int count_children(struct reading *r, const struct xml_element *robot, const char *name, int most) {
    int count = 0;
    for (const struct xml_element *at = xml_child(robot, name); at != NULL; at = xml_again(at)) {
        if (count == most) {
            fault(r, at, NULL, "more than %d <%s>", most, name);
            break;
        }
        count++;
    }
    return count;
}

void elements_read(struct reading *r, struct elements *e) {
    if (strcmp(e->robot->name, "robot") != 0) {
        fault(r, e->robot, NULL, "is no robot file; its first element must be <robot>");
        return;
    }
    const int links = count_children(r, e->robot, "link", MOST_LINKS);
    const int joints = count_children(r, e->robot, "joint", MOST_JOINTS);
    e->links = arena_take(&r->arena, (size_t)links, sizeof *e->links);
    e->joints = arena_take(&r->arena, (size_t)joints, sizeof *e->joints);
    const struct xml_element *at = xml_child(e->robot, "link");
    for (; e->num_links < links; at = xml_again(at)) {
        e->links[e->num_links] = (struct file_link){.at = at, .joint = -1, .name = ""};
        e->num_links++;
        read_link(r, e, &e->links[e->num_links - 1]);
    }
    at = xml_child(e->robot, "joint");
    for (; e->num_joints < joints; at = xml_again(at)) {
        e->joints[e->num_joints] = (struct file_joint){.at = at, .name = ""};
        e->num_joints++;
        read_joint(r, e, &e->joints[e->num_joints - 1]);
    }
    if (links == 0) {
        fault(r, e->robot, NULL, "has no <link>");
    }
}
