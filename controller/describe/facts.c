#include "facts.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "limphome/body/kinematics.h"
#include "limphome/body/rest.h"
#include "limphome/body/stability.h"
#include "sweep.h"

#define BISECTIONS 40
#define HEAVIEST 1e9f /* of what is tried for a load [kg] */
#define TURN 0.01f    /* either way, for a slope over a joint's angle [rad] */
#define NO_LEVER 1e-4 /* a joint that moves the tip up or down by less bears none of its load [m/rad] */
#define QUARTER_TURN 1.5707963f

static const lh_vec3 level = {0.0f, 0.0f, 1.0f};

static void to_doubles(lh_vec3 v, double out[3]) {
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
}

/* Posture of the arm with the body upright. */
static lh_posture upright(const lh_robot *robot, const float *angle) {
    lh_posture posture;
    lh_kinematics_posture(robot, (lh_quat){1.0f, 0.0f, 0.0f, 0.0f}, angle, &posture);
    return posture;
}

/* Supports of the base: on these it stands while its arm is in the air. */
static int32_t base_supports(const lh_robot *robot, const lh_posture *posture, lh_vec3 points[LH_MAX_SUPPORTS]) {
    int32_t count = 0;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        if (robot->supports[i].link == 0) {
            points[count++] = posture->supports[i];
        }
    }
    return count;
}

/* Whether the arm is at the height of the ground or below it, the robot level on its base. */
static bool arm_is_down(const lh_robot *robot, const lh_posture *posture) {
    float ground = FLT_MAX, arm = FLT_MAX;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        float *least = robot->supports[i].link == 0 ? &ground : &arm;
        *least = posture->supports[i].z < *least ? posture->supports[i].z : *least;
    }
    return arm <= ground;
}

/* The robot with these joint angles, put level on its base. With its arm in the air it stays there or tumbles; with its
 * arm on the ground it comes to rest somewhere else. */
static facts_posture stand(const lh_robot *robot, int num_tips, const float *angle) {
    facts_posture facts;
    memset(&facts, 0, sizeof facts);
    memcpy(facts.angle, angle, (size_t)robot->num_actuators * sizeof *angle);
    const lh_posture posture = upright(robot, angle);
    if (arm_is_down(robot, &posture)) {
        lh_rest rest;
        lh_rest_find(robot, angle, level, &rest);
        facts.rests = rest.num_carrying > 0;
        facts.braced = rest.braced;
        facts.margin = (double)rest.margin;
    } else {
        lh_vec3 points[LH_MAX_SUPPORTS];
        const int32_t count = base_supports(robot, &posture, points);
        facts.margin = (double)lh_stability_margin(points, count, posture.centre_of_mass);
        facts.rests = facts.margin > 0.0;
    }
    to_doubles(posture.centre_of_mass, facts.centre_of_mass);
    for (int t = 0; t < num_tips; t++) {
        to_doubles(posture.supports[t], facts.tip[t]);
    }
    return facts;
}

/* The largest x of 0 to `most` at which the robot does not tumble, given that it does beyond. */
static double bisect(bool (*tumbles)(const void *, double), const void *what, double most) {
    double low = 0.0, high = most;
    for (int i = 0; i < BISECTIONS; i++) {
        const double middle = 0.5 * (low + high);
        *(tumbles(what, middle) ? &high : &low) = middle;
    }
    return low;
}

/* Ground that falls towards a direction, or a load at a tip, under a robot that stands on its base. */
struct trial {
    lh_vec3 points[LH_MAX_SUPPORTS];
    int32_t count;
    lh_vec3 centre_of_mass;
    lh_vec3 axis; /* about which the ground tilts */
    lh_vec3 tip;
    double mass; /* of the robot */
};

static bool tumbles_on_slope(const void *what, double angle) {
    const struct trial *t = what;
    const lh_quat turn = lh_quat_about(t->axis, (float)angle);
    lh_vec3 turned[LH_MAX_SUPPORTS];
    for (int32_t i = 0; i < t->count; i++) {
        turned[i] = lh_quat_rotate(turn, t->points[i]);
    }
    return lh_stability_margin(turned, t->count, lh_quat_rotate(turn, t->centre_of_mass)) <= 0.0f;
}

static bool tumbles_under_load(const void *what, double load) {
    const struct trial *t = what;
    const float share = (float)(load / (load + t->mass));
    const lh_vec3 both = lh_vec3_add(lh_vec3_scale(t->centre_of_mass, 1.0f - share), lh_vec3_scale(t->tip, share));
    return lh_stability_margin(t->points, t->count, both) <= 0.0f;
}

static void find_tilts(const lh_robot *robot, const float *angle, double tilt[FACTS_DIRECTIONS]) {
    /* turning about y brings the front down, about -x the left side */
    static const lh_vec3 axes[FACTS_DIRECTIONS] = {[FACTS_FORWARD] = {0, 1, 0},
                                                   [FACTS_LEFT] = {-1, 0, 0},
                                                   [FACTS_BACKWARD] = {0, -1, 0},
                                                   [FACTS_RIGHT] = {1, 0, 0}};
    const lh_posture posture = upright(robot, angle);
    struct trial t = {.centre_of_mass = posture.centre_of_mass};
    t.count = base_supports(robot, &posture, t.points);
    for (int d = 0; d < FACTS_DIRECTIONS; d++) {
        t.axis = axes[d];
        tilt[d] = bisect(tumbles_on_slope, &t, (double)QUARTER_TURN);
    }
}

/* Of the heights of centre of mass and of a tip, the slopes over the angle of a joint: by virtual work its torques. */
struct levers {
    double centre_of_mass, tip; /* [m/rad] */
};

static struct levers levers_of(const lh_robot *robot, const float *angle, int joint, int tip) {
    float turned[ROBOT_MAX_ACTUATORS];
    memcpy(turned, angle, (size_t)robot->num_actuators * sizeof *angle);
    turned[joint] = angle[joint] + TURN;
    const lh_posture more = upright(robot, turned);
    turned[joint] = angle[joint] - TURN;
    const lh_posture less = upright(robot, turned);
    return (struct levers){(double)((more.centre_of_mass.z - less.centre_of_mass.z) / (2.0f * TURN)),
                           (double)((more.supports[tip].z - less.supports[tip].z) / (2.0f * TURN))};
}

static void bound(double *least, int *by, double value, int what) {
    if (value < *least) {
        *least = value;
        *by = what;
    }
}

/* A joint's torque against gravity is M g dz/dq of the centre of mass, and W g dz/dq of the tip for a load W there. */
static facts_strength strength(const lh_robot *robot, double mass, const float *angle, int tip) {
    facts_strength s = {HUGE_VAL, FACTS_UNBOUNDED, HUGE_VAL, FACTS_UNBOUNDED};
    for (int j = ROBOT_CRAWLERS; j < robot->num_actuators; j++) {
        const struct levers lever = levers_of(robot, angle, j, tip);
        const double per_load = fabs(lever.tip);
        if (per_load > NO_LEVER) {
            const double own = mass * FACTS_GRAVITY * lever.centre_of_mass * (lever.tip < 0.0 ? -1.0 : 1.0);
            const double effort = (double)robot->actuators[j].effort_limit;
            bound(&s.lift, &s.lift_bound, (effort - own) / (per_load * FACTS_GRAVITY), j);
            bound(&s.press, &s.press_bound, (effort + own) / per_load, j);
        }
    }
    const lh_posture posture = upright(robot, angle);
    struct trial t = {.centre_of_mass = posture.centre_of_mass, .tip = posture.supports[tip], .mass = mass};
    t.count = base_supports(robot, &posture, t.points);
    if (tumbles_under_load(&t, (double)HEAVIEST)) {
        bound(&s.lift, &s.lift_bound, bisect(tumbles_under_load, &t, (double)HEAVIEST), FACTS_TUMBLES);
    }
    return s;
}

struct search {
    const lh_robot *robot;
    int num_tips;
    robot_facts *facts;
};

static double distance_out(const facts_posture *posture, int tip) {
    return hypot(posture->tip[tip][0], posture->tip[tip][1]);
}

/* Takes one posture of the sweep into account. */
static void visit(void *what, const float *angle) {
    const struct search *s = what;
    robot_facts *facts = s->facts;
    const facts_posture here = stand(s->robot, s->num_tips, angle);
    const bool on_crawlers = here.rests && !here.braced;
    facts->num_postures++;
    facts->num_braced += here.rests && here.braced;
    facts->num_nowhere += !here.rests;
    if (on_crawlers && here.margin < facts->least.margin) {
        facts->least = here;
    }
    for (int i = 0; i < s->num_tips; i++) {
        facts_tip *tip = &facts->tips[i];
        tip->low = fmin(tip->low, here.tip[i][2]);
        tip->high = fmax(tip->high, here.tip[i][2]);
        if (on_crawlers && distance_out(&here, i) > tip->reach) {
            tip->reach = distance_out(&here, i);
            tip->far = here;
        }
    }
}

static double ground_pressure(const robot_description *description, double mass) {
    double area = 0.0;
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        const robot_crawler *c = &description->crawlers[i];
        area += c->width * (c->length - 2.0 * c->radius);
    }
    return mass * FACTS_GRAVITY / area;
}

void facts_find(const robot_description *description, const lh_robot *robot, robot_facts *facts) {
    memset(facts, 0, sizeof *facts);
    for (int i = 0; i < description->num_bodies; i++) {
        facts->mass += description->bodies[i].mass;
    }
    facts->ground_pressure = ground_pressure(description, facts->mass);
    float home[ROBOT_MAX_ACTUATORS] = {0};
    for (int i = ROBOT_CRAWLERS; i < description->num_actuators; i++) {
        home[i] = (float)description->actuators[i].home;
    }
    facts->home = stand(robot, description->num_tips, home);
    find_tilts(robot, home, facts->tilt);
    facts->least.margin = HUGE_VAL;
    for (int i = 0; i < description->num_tips; i++) {
        facts->tips[i] = (facts_tip){.low = HUGE_VAL, .high = -HUGE_VAL};
    }
    sweep(robot, visit, &(struct search){robot, description->num_tips, facts});
    for (int i = 0; i < description->num_tips; i++) {
        facts_tip *tip = &facts->tips[i];
        tip->home = strength(robot, facts->mass, home, i);
        tip->there = strength(robot, facts->mass, tip->far.angle, i);
    }
}
