#include "urdf.h"

#include <errno.h>
#include <expat.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_JOINTS = LH_MAX_LINKS, MAX_CRAWLERS = 2 };

/* Links and joints as they stand in the file, in any order. */
struct link {
    char name[URDF_NAME_LENGTH];
    float mass;
    lh_vec3 centre;
};

struct joint {
    char name[URDF_NAME_LENGTH];
    char parent[URDF_NAME_LENGTH];
    char child[URDF_NAME_LENGTH];
    lh_vec3 origin;
    lh_quat rotation;
    lh_vec3 axis;
    bool limited; /* has low and high, that is, is revolute */
    float low, high, effort;
};

struct support {
    char link[URDF_NAME_LENGTH];
    lh_vec3 point;
    float radius;
};

struct reading {
    XML_Parser parser;
    const char *path;
    char *error;
    bool failed;
    bool extended; /* <limphome> was there */

    /* the element under way */
    int depth; /* 1: child of <robot> */
    bool in_extension;
    struct link *in_link;
    struct joint *in_joint;
    bool in_inertial;

    int num_links, num_joints, num_crawlers, num_arm, num_supports;
    struct link links[LH_MAX_LINKS];
    struct joint joints[MAX_JOINTS];
    char crawlers[MAX_CRAWLERS][URDF_NAME_LENGTH];
    char arm[LH_MAX_ACTUATORS][URDF_NAME_LENGTH];
    struct support supports[LH_MAX_SUPPORTS];
};

/* Notes the first error, with file and line. */
__attribute__((format(printf, 2, 3))) static void fail(struct reading *r, const char *format, ...) {
    if (r->failed) {
        return;
    }
    r->failed = true;
    const int used =
        snprintf(r->error, URDF_ERROR_LENGTH, "%.200s:%lu: ", r->path, XML_GetCurrentLineNumber(r->parser));
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error + used, (size_t)(URDF_ERROR_LENGTH - used), format, arguments);
    va_end(arguments);
}

static const char *attribute(const char **attributes, const char *name) {
    for (; attributes[0] != NULL; attributes += 2) {
        if (strcmp(attributes[0], name) == 0) {
            return attributes[1];
        }
    }
    return NULL;
}

/* Copies a name that must be there. */
static void read_name(struct reading *r, const char *element, const char **attributes, const char *key,
                      char name[URDF_NAME_LENGTH]) {
    const char *value = attribute(attributes, key);
    if (value == NULL || value[0] == '\0' || strlen(value) >= URDF_NAME_LENGTH) {
        fail(r, "<%s>: needs %s of 1 to %d characters", element, key, URDF_NAME_LENGTH - 1);
        return;
    }
    snprintf(name, URDF_NAME_LENGTH, "%s", value);
}

/* Reads `count` finite numbers separated by white space; the attribute may be absent unless it is required. */
static void read_numbers(struct reading *r, const char *element, const char **attributes, const char *key,
                         bool required, float *numbers, int count) {
    const char *value = attribute(attributes, key);
    if (value == NULL) {
        if (required) {
            fail(r, "<%s>: needs %s", element, key);
        }
        return;
    }
    const char *at = value;
    for (int i = 0; i < count; i++) {
        char *end = NULL;
        const float number = strtof(at, &end);
        if (end == at || !isfinite(number)) {
            fail(r, "<%s>: %s=\"%.60s\" must be %d finite number%s", element, key, value, count, count > 1 ? "s" : "");
            return;
        }
        numbers[i] = number;
        at = end;
    }
    if (at[strspn(at, " \t\r\n")] != '\0') {
        fail(r, "<%s>: %s=\"%.60s\" must be %d finite number%s", element, key, value, count, count > 1 ? "s" : "");
    }
}

static lh_vec3 read_vector(struct reading *r, const char *element, const char **attributes, const char *key,
                           lh_vec3 standard) {
    float v[3] = {standard.x, standard.y, standard.z};
    read_numbers(r, element, attributes, key, false, v, 3);
    return (lh_vec3){v[0], v[1], v[2]};
}

/* Fixed-axis roll, pitch, yaw of URDF as a quaternion. */
static lh_quat from_rpy(lh_vec3 rpy) {
    const lh_quat roll = lh_quat_about((lh_vec3){1, 0, 0}, rpy.x);
    const lh_quat pitch = lh_quat_about((lh_vec3){0, 1, 0}, rpy.y);
    const lh_quat yaw = lh_quat_about((lh_vec3){0, 0, 1}, rpy.z);
    return lh_quat_multiply(yaw, lh_quat_multiply(pitch, roll));
}

static void begin_link(struct reading *r, const char **attributes) {
    if (r->num_links == LH_MAX_LINKS) {
        fail(r, "<link>: more than %d links", LH_MAX_LINKS);
        return;
    }
    r->in_link = &r->links[r->num_links++];
    read_name(r, "link", attributes, "name", r->in_link->name);
}

static void begin_joint(struct reading *r, const char **attributes) {
    if (r->num_joints == MAX_JOINTS) {
        fail(r, "<joint>: more than %d joints", MAX_JOINTS);
        return;
    }
    r->in_joint = &r->joints[r->num_joints++];
    r->in_joint->axis = (lh_vec3){1, 0, 0}; /* URDF's default */
    r->in_joint->rotation = (lh_quat){1, 0, 0, 0};
    read_name(r, "joint", attributes, "name", r->in_joint->name);
    const char *type = attribute(attributes, "type");
    if (type == NULL ||
        (strcmp(type, "revolute") != 0 && strcmp(type, "continuous") != 0 && strcmp(type, "fixed") != 0)) {
        fail(r, "<joint name=\"%s\">: type must be revolute, continuous or fixed", r->in_joint->name);
        return;
    }
    r->in_joint->limited = strcmp(type, "revolute") == 0;
}

static void read_joint_part(struct reading *r, const char *element, const char **attributes) {
    struct joint *joint = r->in_joint;
    if (strcmp(element, "parent") == 0) {
        read_name(r, element, attributes, "link", joint->parent);
    } else if (strcmp(element, "child") == 0) {
        read_name(r, element, attributes, "link", joint->child);
    } else if (strcmp(element, "origin") == 0) {
        joint->origin = read_vector(r, element, attributes, "xyz", (lh_vec3){0, 0, 0});
        joint->rotation = from_rpy(read_vector(r, element, attributes, "rpy", (lh_vec3){0, 0, 0}));
    } else if (strcmp(element, "axis") == 0) {
        const lh_vec3 axis = read_vector(r, element, attributes, "xyz", joint->axis);
        if (!(lh_vec3_norm(axis) > 1e-3F)) {
            fail(r, "<axis> of joint %s: has no direction", joint->name);
            return;
        }
        joint->axis = lh_vec3_scale(axis, 1 / lh_vec3_norm(axis));
    } else if (strcmp(element, "limit") == 0) {
        read_numbers(r, element, attributes, "effort", true, &joint->effort, 1);
        read_numbers(r, element, attributes, "lower", joint->limited, &joint->low, 1);
        read_numbers(r, element, attributes, "upper", joint->limited, &joint->high, 1);
    }
}

static void read_link_part(struct reading *r, const char *element, const char **attributes) {
    if (strcmp(element, "inertial") == 0) {
        r->in_inertial = true;
    } else if (r->in_inertial && strcmp(element, "origin") == 0) {
        r->in_link->centre = read_vector(r, element, attributes, "xyz", (lh_vec3){0, 0, 0});
    } else if (r->in_inertial && strcmp(element, "mass") == 0) {
        read_numbers(r, element, attributes, "value", true, &r->in_link->mass, 1);
        if (!(r->in_link->mass >= 0)) {
            fail(r, "<mass> of link %s: must not be negative", r->in_link->name);
        }
    }
}

static void read_support(struct reading *r, const char *element, const char **attributes) {
    if (r->num_supports == LH_MAX_SUPPORTS) {
        fail(r, "<%s>: more than %d supports", element, LH_MAX_SUPPORTS);
        return;
    }
    struct support *support = &r->supports[r->num_supports++];
    read_name(r, element, attributes, "link", support->link);
    support->point = read_vector(r, element, attributes, "xyz", (lh_vec3){0, 0, 0});
    read_numbers(r, element, attributes, "radius", false, &support->radius, 1);
    if (!(support->radius >= 0)) {
        fail(r, "<%s>: radius must not be negative", element);
    }
}

static void read_extension_part(struct reading *r, const char *element, const char **attributes) {
    if (strcmp(element, "crawler") == 0) {
        if (r->num_crawlers == MAX_CRAWLERS) {
            fail(r, "<crawler>: must be two, left then right");
            return;
        }
        read_name(r, element, attributes, "joint", r->crawlers[r->num_crawlers++]);
    } else if (strcmp(element, "arm") == 0) {
        if (r->num_arm == LH_MAX_ACTUATORS - MAX_CRAWLERS) {
            fail(r, "<arm>: more than %d arm joints", LH_MAX_ACTUATORS - MAX_CRAWLERS);
            return;
        }
        read_name(r, element, attributes, "joint", r->arm[r->num_arm++]);
    } else if (strcmp(element, "support") == 0 || strcmp(element, "tip") == 0) {
        read_support(r, element, attributes);
    } else {
        fail(r, "<%s>: unknown inside <limphome>; known are crawler, arm, tip, support", element);
    }
}

static void begin_element(void *user, const char *element, const char **attributes) {
    struct reading *r = user;
    const int depth = r->depth++;
    if (r->failed) {
        return;
    }
    if (r->in_extension) {
        read_extension_part(r, element, attributes);
    } else if (r->in_joint != NULL) {
        read_joint_part(r, element, attributes);
    } else if (r->in_link != NULL) {
        read_link_part(r, element, attributes);
    } else if (depth != 1) { /* of an extension that is not ours, or <robot> itself */
        return;
    } else if (strcmp(element, "link") == 0) {
        begin_link(r, attributes);
    } else if (strcmp(element, "joint") == 0) {
        begin_joint(r, attributes);
    } else if (strcmp(element, "limphome") == 0) {
        r->extended = r->in_extension = true;
    }
}

static void end_element(void *user, const char *element) {
    struct reading *r = user;
    r->depth--;
    if (r->depth == 1) {
        r->in_link = NULL;
        r->in_joint = NULL;
        r->in_extension = false;
    } else if (strcmp(element, "inertial") == 0) {
        r->in_inertial = false;
    }
}

static struct link *find_link(struct reading *r, const char *name) {
    for (int i = 0; i < r->num_links; i++) {
        if (strcmp(r->links[i].name, name) == 0) {
            return &r->links[i];
        }
    }
    return NULL;
}

static struct joint *find_joint(struct reading *r, const char *name) {
    for (int i = 0; i < r->num_joints; i++) {
        if (strcmp(r->joints[i].name, name) == 0) {
            return &r->joints[i];
        }
    }
    return NULL;
}

static const struct joint *joint_of_child(const struct reading *r, const char *link) {
    for (int i = 0; i < r->num_joints; i++) {
        if (strcmp(r->joints[i].child, link) == 0) {
            return &r->joints[i];
        }
    }
    return NULL;
}

/* Crawlers first, then the arm; their joints must exist, and an arm joint must have a range. */
static void build_actuators(struct reading *r, urdf_robot *out) {
    if (r->num_crawlers != MAX_CRAWLERS) {
        fail(r, "<limphome>: needs two <crawler> elements, left then right");
        return;
    }
    for (int i = 0; i < r->num_crawlers + r->num_arm; i++) {
        const bool crawler = i < r->num_crawlers;
        const char *name = crawler ? r->crawlers[i] : r->arm[i - r->num_crawlers];
        const struct joint *joint = find_joint(r, name);
        if (joint == NULL) {
            fail(r, "<limphome>: there is no joint %s", name);
            return;
        }
        if (!(joint->effort > 0)) {
            fail(r, "joint %s: needs <limit> with effort above 0", name);
            return;
        }
        if (!crawler && !(joint->limited && joint->high > joint->low)) {
            fail(r, "joint %s: must be revolute with lower below upper", name);
            return;
        }
        lh_actuator *actuator = &out->robot.actuators[out->robot.num_actuators];
        actuator->kind = crawler ? LH_CRAWLER : LH_JOINT;
        actuator->low = crawler ? 0 : joint->low;
        actuator->high = crawler ? 0 : joint->high;
        actuator->effort_limit = joint->effort;
        snprintf(out->actuator_name[out->robot.num_actuators++], URDF_NAME_LENGTH, "%s", name);
    }
}

/* Index of the arm actuator of that name, or -1: what a joint must have for its angle to move masses. */
static int32_t arm_actuator(const urdf_robot *out, const char *name) {
    for (int32_t i = 0; i < out->robot.num_actuators; i++) {
        if (out->robot.actuators[i].kind == LH_JOINT && strcmp(out->actuator_name[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

/* Orders the links so that each follows its parent; `order` receives indices into r->links. */
static void build_links(struct reading *r, urdf_robot *out, int order[LH_MAX_LINKS]) {
    bool placed[LH_MAX_LINKS] = {false};
    lh_robot *robot = &out->robot;
    for (bool progress = true; progress;) {
        progress = false;
        for (int i = 0; i < r->num_links; i++) {
            const struct joint *joint = joint_of_child(r, r->links[i].name);
            int32_t parent = -1;
            for (int32_t k = 0; k < robot->num_links && joint != NULL; k++) {
                parent = strcmp(r->links[order[k]].name, joint->parent) == 0 ? k : parent;
            }
            const bool root = joint == NULL && robot->num_links == 0;
            if (placed[i] || !(root || parent >= 0)) {
                continue;
            }
            robot->links[robot->num_links] = (lh_link){
                .parent = parent,
                .actuator = root ? -1 : arm_actuator(out, joint->name),
                .origin = root ? (lh_vec3){0, 0, 0} : joint->origin,
                .rotation = root ? (lh_quat){1, 0, 0, 0} : joint->rotation,
                .axis = root ? (lh_vec3){0, 0, 1} : joint->axis,
                .mass = r->links[i].mass,
                .centre = r->links[i].centre,
            };
            order[robot->num_links++] = i;
            placed[i] = true;
            progress = true;
        }
    }
    for (int i = 0; i < r->num_links; i++) {
        if (!placed[i]) {
            fail(r, "link %s: is not joined to the root link", r->links[i].name);
        }
    }
}

static void build_supports(struct reading *r, urdf_robot *out, const int order[LH_MAX_LINKS]) {
    for (int i = 0; i < r->num_supports; i++) {
        const struct link *link = find_link(r, r->supports[i].link);
        if (link == NULL) {
            fail(r, "<limphome>: there is no link %s to stand on", r->supports[i].link);
            return;
        }
        int32_t index = 0;
        while (&r->links[order[index]] != link) {
            index++;
        }
        out->robot.supports[out->robot.num_supports++] =
            (lh_support){.link = index, .point = r->supports[i].point, .radius = r->supports[i].radius};
    }
}

static void build(struct reading *r, urdf_robot *out) {
    int order[LH_MAX_LINKS] = {0};
    if (!r->extended) {
        fail(r, "<limphome>: missing; it names crawlers, arm joints and supports");
    }
    if (!r->failed) {
        build_actuators(r, out);
    }
    if (!r->failed) {
        build_links(r, out, order);
    }
    if (!r->failed) {
        build_supports(r, out, order);
    }
    const lh_error error = r->failed ? LH_OK : lh_robot_validate(&out->robot);
    if (error != LH_OK) {
        fail(r, "%s", lh_error_text(error));
    }
}

static void parse(struct reading *r, FILE *file, urdf_robot *out) {
    char buffer[4096];
    out->hash = 14695981039346656037u;
    for (bool last = false; !last && !r->failed;) {
        const size_t length = fread(buffer, 1, sizeof buffer, file);
        last = length < sizeof buffer;
        for (size_t i = 0; i < length; i++) {
            out->hash = (out->hash ^ (unsigned char)buffer[i]) * 1099511628211u;
        }
        if (XML_Parse(r->parser, buffer, (int)length, last) == XML_STATUS_ERROR) {
            fail(r, "not XML: %s", XML_ErrorString(XML_GetErrorCode(r->parser)));
        }
    }
    if (ferror(file)) {
        fail(r, "cannot be read");
    }
}

int urdf_read(urdf_robot *robot, const char *path, char error[URDF_ERROR_LENGTH]) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        snprintf(error, URDF_ERROR_LENGTH, "%.200s: cannot be opened: %s", path, strerror(errno));
        return -1;
    }
    struct reading reading = {.path = path, .error = error, .parser = XML_ParserCreate(NULL)};
    if (reading.parser == NULL) {
        snprintf(error, URDF_ERROR_LENGTH, "%.200s: out of memory", path);
        fclose(file);
        return -1;
    }
    XML_SetUserData(reading.parser, &reading);
    XML_SetElementHandler(reading.parser, begin_element, end_element);

    urdf_robot read;
    memset(&read, 0, sizeof read);
    parse(&reading, file, &read);
    fclose(file);
    if (!reading.failed) {
        build(&reading, &read);
    }
    XML_ParserFree(reading.parser);
    if (reading.failed) {
        return -1;
    }
    *robot = read;
    return 0;
}
