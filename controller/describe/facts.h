/* What follows from a robot description, by the library's own mathematics: how the robot stands, what makes it tumble,
 * what its arm reaches and bears. All quasi-static and on even, firm ground; whether the arm meets the robot's own body
 * on the way is not looked at. Lengths in m, angles in rad, masses in kg, forces in N, frame of the base. */
#ifndef LIMPHOME_DESCRIBE_FACTS_H
#define LIMPHOME_DESCRIBE_FACTS_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/body/robot.h"
#include "robot_description.h"

#define FACTS_GRAVITY 9.81 /* [m/s^2] */

enum facts_direction { FACTS_FORWARD, FACTS_LEFT, FACTS_BACKWARD, FACTS_RIGHT, FACTS_DIRECTIONS };

/* What bounds how much a tip can lift or press. */
enum { FACTS_TUMBLES = -1, FACTS_UNBOUNDED = -2 }; /* else the index of the actuator that is too weak */

/* The robot put down in one posture of its arm. */
typedef struct facts_posture {
    float angle[ROBOT_MAX_ACTUATORS]; /* of the joints; 0 for crawlers */
    bool rests;                       /* on its crawlers, or with its arm on the ground on that, too; else it tumbles */
    bool braced;                      /* on the arm, too */
    double margin;                    /* S_NE of (11) there [m] */
    double centre_of_mass[3];
    double tip[ROBOT_MAX_SUPPORTS][3]; /* [num_tips] lowest points */
} facts_posture;

/* What a tip can do in one posture, its robot standing on its crawlers. */
typedef struct facts_strength {
    double lift; /* mass it can hold up; below 0: the arm cannot hold itself [kg] */
    int lift_bound;
    double press; /* force it can press down with before a joint gives way [N] */
    int press_bound;
} facts_strength;

typedef struct facts_tip {
    facts_strength home;  /* what it can do in the initial pose */
    facts_posture far;    /* the posture in which it is farthest out and the robot stands on its crawlers */
    facts_strength there; /* what it can do in that */
    double reach;         /* how far out that is: from the middle between the crawlers, seen from above */
    double low, high;     /* least and largest height of its lowest point over the ground, the robot level */
} facts_tip;

typedef struct robot_facts {
    double mass;
    double ground_pressure; /* under the flat runs of the belts, the load even on both [Pa] */
    facts_posture home;
    double tilt[FACTS_DIRECTIONS]; /* of the ground at which it tumbles in its initial pose, that side downhill */
    int num_postures;              /* of the sweep: even steps over all joints' ranges */
    int num_braced;                /* of these, in which the arm carries, too */
    int num_nowhere;               /* in which it tumbles */
    facts_posture least; /* of those in which it stands on its crawlers alone, the one with the least margin */
    facts_tip tips[ROBOT_MAX_SUPPORTS]; /* [num_tips] */
} robot_facts;

/* `robot` is `description` as convert_robot gives it. */
void facts_find(const robot_description *description, const lh_robot *robot, robot_facts *facts);

#endif
