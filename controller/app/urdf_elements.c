#include "urdf_elements.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void urdf_fail(struct urdf_reading *r, const char *format, ...) {
    if (r->failed) {
        return;
    }
    r->failed = true;
    char reason[ERROR_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    fail_with(r->error, "%.200s:%lu: %s", r->path, XML_GetCurrentLineNumber(r->parser), reason);
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
static void read_name(struct urdf_reading *r, const char *element, const char **attributes, const char *key,
                      char name[URDF_NAME_LENGTH]) {
    const char *value = attribute(attributes, key);
    if (value == NULL || value[0] == '\0' || strlen(value) >= URDF_NAME_LENGTH) {
        urdf_fail(r, "<%s>: needs %s of 1 to %d characters", element, key, URDF_NAME_LENGTH - 1);
        return;
    }
    snprintf(name, URDF_NAME_LENGTH, "%s", value);
}

/* Reads `count` finite numbers separated by white space; the attribute may be absent unless it is required. */
static void read_numbers(struct urdf_reading *r, const char *element, const char **attributes, const char *key,
                         bool required, float *numbers, int count) {
    const char *value = attribute(attributes, key);
    if (value == NULL) {
        if (required) {
            urdf_fail(r, "<%s>: needs %s", element, key);
        }
        return;
    }
    const char *at = value;
    for (int i = 0; i < count; i++) {
        char *end = NULL;
        const float number = strtof(at, &end);
        if (end == at || !isfinite(number)) {
            urdf_fail(r, "<%s>: %s=\"%.60s\" must be %d finite number%s", element, key, value, count,
                      count > 1 ? "s" : "");
            return;
        }
        numbers[i] = number;
        at = end;
    }
    if (at[strspn(at, " \t\r\n")] != '\0') {
        urdf_fail(r, "<%s>: %s=\"%.60s\" must be %d finite number%s", element, key, value, count, count > 1 ? "s" : "");
    }
}

static lh_vec3 read_vector(struct urdf_reading *r, const char *element, const char **attributes, const char *key,
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

static void begin_link(struct urdf_reading *r, const char **attributes) {
    if (r->num_links == LH_MAX_LINKS) {
        urdf_fail(r, "<link>: more than %d links", LH_MAX_LINKS);
        return;
    }
    r->in_link = &r->links[r->num_links++];
    read_name(r, "link", attributes, "name", r->in_link->name);
}

static void begin_joint(struct urdf_reading *r, const char **attributes) {
    if (r->num_joints == URDF_MAX_JOINTS) {
        urdf_fail(r, "<joint>: more than %d joints", URDF_MAX_JOINTS);
        return;
    }
    r->in_joint = &r->joints[r->num_joints++];
    r->in_joint->axis = (lh_vec3){1, 0, 0}; /* URDF's default */
    r->in_joint->rotation = (lh_quat){1, 0, 0, 0};
    read_name(r, "joint", attributes, "name", r->in_joint->name);
    const char *type = attribute(attributes, "type");
    if (type == NULL ||
        (strcmp(type, "revolute") != 0 && strcmp(type, "continuous") != 0 && strcmp(type, "fixed") != 0)) {
        urdf_fail(r, "<joint name=\"%s\">: type must be revolute, continuous or fixed", r->in_joint->name);
        return;
    }
    r->in_joint->limited = strcmp(type, "revolute") == 0;
}

static void read_joint_part(struct urdf_reading *r, const char *element, const char **attributes) {
    struct urdf_joint *joint = r->in_joint;
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
            urdf_fail(r, "<axis> of joint %s: has no direction", joint->name);
            return;
        }
        joint->axis = lh_vec3_scale(axis, 1 / lh_vec3_norm(axis));
    } else if (strcmp(element, "limit") == 0) {
        read_numbers(r, element, attributes, "effort", true, &joint->effort, 1);
        read_numbers(r, element, attributes, "lower", joint->limited, &joint->low, 1);
        read_numbers(r, element, attributes, "upper", joint->limited, &joint->high, 1);
    }
}

static void read_link_part(struct urdf_reading *r, const char *element, const char **attributes) {
    if (strcmp(element, "inertial") == 0) {
        r->in_inertial = true;
    } else if (r->in_inertial && strcmp(element, "origin") == 0) {
        r->in_link->centre = read_vector(r, element, attributes, "xyz", (lh_vec3){0, 0, 0});
    } else if (r->in_inertial && strcmp(element, "mass") == 0) {
        read_numbers(r, element, attributes, "value", true, &r->in_link->mass, 1);
        if (!(r->in_link->mass >= 0)) {
            urdf_fail(r, "<mass> of link %s: must not be negative", r->in_link->name);
        }
    }
}

static void read_support(struct urdf_reading *r, const char *element, const char **attributes) {
    if (r->num_supports == LH_MAX_SUPPORTS) {
        urdf_fail(r, "<%s>: more than %d supports", element, LH_MAX_SUPPORTS);
        return;
    }
    struct urdf_support *support = &r->supports[r->num_supports++];
    read_name(r, element, attributes, "link", support->link);
    support->point = read_vector(r, element, attributes, "xyz", (lh_vec3){0, 0, 0});
    read_numbers(r, element, attributes, "radius", false, &support->radius, 1);
    if (!(support->radius >= 0)) {
        urdf_fail(r, "<%s>: radius must not be negative", element);
    }
}

static void read_extension_part(struct urdf_reading *r, const char *element, const char **attributes) {
    if (strcmp(element, "crawler") == 0) {
        if (r->num_crawlers == URDF_CRAWLERS) {
            urdf_fail(r, "<crawler>: must be two, left then right");
            return;
        }
        read_name(r, element, attributes, "joint", r->crawlers[r->num_crawlers++]);
    } else if (strcmp(element, "arm") == 0) {
        if (r->num_arm == LH_MAX_ACTUATORS - URDF_CRAWLERS) {
            urdf_fail(r, "<arm>: more than %d arm joints", LH_MAX_ACTUATORS - URDF_CRAWLERS);
            return;
        }
        read_name(r, element, attributes, "joint", r->arm[r->num_arm++]);
    } else if (strcmp(element, "support") == 0 || strcmp(element, "tip") == 0) {
        read_support(r, element, attributes);
    } else {
        urdf_fail(r, "<%s>: unknown inside <limphome>; known are crawler, arm, tip, support", element);
    }
}

static void begin_element(void *user, const char *element, const char **attributes) {
    struct urdf_reading *r = user;
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
    struct urdf_reading *r = user;
    r->depth--;
    if (r->depth == 1) {
        r->in_link = NULL;
        r->in_joint = NULL;
        r->in_extension = false;
    } else if (strcmp(element, "inertial") == 0) {
        r->in_inertial = false;
    }
}

void urdf_read_elements(struct urdf_reading *r, FILE *file) {
    XML_SetUserData(r->parser, r);
    XML_SetElementHandler(r->parser, begin_element, end_element);
    char buffer[4096];
    r->hash = 14695981039346656037u;
    for (bool last = false; !last && !r->failed;) {
        const size_t length = fread(buffer, 1, sizeof buffer, file);
        if (ferror(file)) {
            urdf_fail(r, "cannot be read: %s", strerror(errno));
            return;
        }
        last = length < sizeof buffer;
        for (size_t i = 0; i < length; i++) {
            r->hash = (r->hash ^ (unsigned char)buffer[i]) * 1099511628211u;
        }
        if (XML_Parse(r->parser, buffer, (int)length, last) == XML_STATUS_ERROR) {
            urdf_fail(r, "not XML: %s", XML_ErrorString(XML_GetErrorCode(r->parser)));
        }
    }
}
