/* Links, joints and the extension as they stand in the file, names still unresolved but numbers read and checked one by
 * one. What they are together is for tree.h and the files that follow it. */
#ifndef LIMPHOME_ROBOT_ELEMENTS_H
#define LIMPHOME_ROBOT_ELEMENTS_H

#include "reading.h"
#include "xml.h"

enum { MOST_LINKS = 1024, MOST_JOINTS = 1024 };

struct file_shape {
    const struct xml_element *at; /* <collision> */
    robot_shape_kind kind;
    frame pose; /* in the frame of its link */
    vector half_size;
    bool from_mesh; /* the box round it */
};

struct file_link {
    const struct xml_element *at;
    const char *name;
    double mass; /* 0: a frame without mass */
    frame inertial;
    matrix inertia;                                 /* about the centre of mass, axes of `inertial` */
    const struct xml_element *mass_at, *inertia_at; /* or NULL */
    struct file_shape *shapes;                      /* [num_seen] those that touch, then those that are only seen */
    int num_shapes, num_seen;

    /* as found by tree_resolve and merge */
    int joint; /* it hangs on, -1: none */
    int body;
    frame pose; /* in the frame of its body */
};

enum joint_type { JOINT_FIXED, JOINT_REVOLUTE, JOINT_CONTINUOUS, JOINT_PRISMATIC, JOINT_FLOATING, JOINT_PLANAR };

struct file_joint {
    const struct xml_element *at;
    const char *name;
    enum joint_type type;
    const char *parent_name, *child_name;
    frame origin;
    vector axis; /* unit; zero where the type has none */
    double lower, upper, effort, velocity;
    const struct xml_element *mimic; /* or NULL */
    double multiplier, offset;
    const struct xml_element *hold; /* or NULL */

    int parent, child; /* links */
    int actuator;      /* -1: none, it is fixed or held */
    double home;       /* where it is held, or starts [rad, m] */
};

/* <crawler>, <arm>: an actuator. */
struct file_actuator {
    const struct xml_element *at;
    bool crawler;
    int joint;                    /* -1: a crawler that has its sprocket from sprocket.h */
    int link;                     /* crawler without a joint: that it is fixed to */
    double inertia;               /* crawler without a joint: of its drive train; 0: not given */
    double effort, velocity;      /* those of the extension, else of the joint */
    double lower, upper;          /* arm */
    vector centre;                /* crawler, in the frame of the joint's parent link or of its own */
    double length, width, radius; /* crawler */
};

/* <tip>, <support> */
struct file_support {
    const struct xml_element *at;
    int link;
    vector point;
    double radius;
};

struct elements {
    const struct xml_element *robot, *extension;
    struct file_link *links;
    struct file_joint *joints;
    struct file_actuator actuators[ROBOT_MAX_ACTUATORS];   /* crawlers first */
    struct file_support supports[ROBOT_MAX_SUPPORTS];      /* tips first */
    int moved[ROBOT_MAX_BODIES];                           /* link that the joint of a body moves; [0]: the root */
    const struct file_link *shape_links[ROBOT_MAX_SHAPES]; /* of the robot's shapes, as found by touch_find */
    int num_links, num_joints, num_actuators, num_supports, num_tips;
};

/* The links and joints of <robot>. */
void elements_read(struct reading *r, struct elements *e);

/* The shapes of a link, of <collision> and <visual>. */
void shapes_read(struct reading *r, struct file_link *link);

/* <limphome>: which joints are actuators, what the robot stands on. Needs links and joints resolved (tree.h). */
void extension_read(struct reading *r, struct elements *e);

/* Index of the link or joint that an attribute names, or -1 with a fault. */
int read_known(struct reading *r, const struct xml_element *at, const char *key, const struct elements *e,
               int (*find)(const struct elements *, const char *));

/* Index of the link or joint of that name, or -1. */
int find_link(const struct elements *e, const char *name);
int find_joint(const struct elements *e, const char *name);

/* Whether a body is the sprocket of a crawler. */
bool is_sprocket(int body);

/* Whether a point is farther away than anything of a robot: chains of links may lead there where none of them does. */
bool is_far(const double point[3]);

#endif
