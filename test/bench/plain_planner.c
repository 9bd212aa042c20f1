/* The straightforward loops over what planner.h, quasi_static.h and motion_model.h say in words, with libm: each action
 * by itself, each of all measurements, nothing kept for later. Compiled with REAL float and double. How the robot rests
 * and where its supports go are the library's. */
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>

#include "limphome/base/elementary.h"
#include "planner.h"

#define WIDE_WEIGHT (REAL)0.1 /* constants of the planner, by the same names */
#define SAME_WIDTHS (REAL)0.3
#define STEERING_BEND (REAL)0.1
#define SAFE_MARGIN (REAL)0.02
#define GROUND_RATE 0.05f
#define FRICTION 0.7f
#define JAMMED (REAL)0.6

enum { JOINTS = LH_PLANNED_JOINTS, PARTS = LH_MOTION_PARTS };

typedef struct motion {
    REAL part[PARTS]; /* forward, sideways, turn, moved */
} motion;

typedef struct sample {
    int32_t action, count, updated;
    REAL angle[JOINTS];
    motion difference;
} sample;

typedef struct option {
    int32_t action;
    REAL reward, value, heading, lateral;
    float angle[JOINTS];
} option;

static const REAL steering_degrees[LH_STEERINGS] = {-50, -20, -8, -3, 0, 3, 8, 20, 50};

static const course_of_decisions *given;
static const lh_planner *planner; /* as it began: robot, settings, lattice */
static sample samples[LH_MAX_SAMPLES];
static int32_t num_samples;
static REAL value[LH_MAX_POSTURES][LH_STEERINGS];
static REAL cost[LH_MAX_POSTURES];
static REAL steerings[LH_STEERINGS];
static lh_vec3 ground, up;
static int32_t turn, last_node, last_action;
static float last_angle[JOINTS];
static lh_pose2 last_pose;
static motion last_expected;
static lh_rest rest; /* of the posture looked at */
static lh_footing footing;

static void begin(const course_of_decisions *course) {
    given = course;
    planner = &course->planner;
    const lh_motion_model *model = &planner->learned.model;
    num_samples = model->num_samples;
    for (int32_t i = 0; i < num_samples; i++) {
        samples[i].action = model->action[i];
        samples[i].count = model->count[i];
        samples[i].updated = model->updated[i];
        for (int32_t k = 0; k < JOINTS; k++) {
            samples[i].angle[k] = (REAL)model->low[k] + (REAL)model->posture[k][i] * (REAL)model->width[k] / 512;
        }
        for (int32_t k = 0; k < PARTS; k++) {
            samples[i].difference.part[k] = (REAL)model->motion[k][i] / 16384;
        }
    }
    for (int32_t node = 0; node < planner->learned.values.num_nodes; node++) {
        cost[node] = (REAL)planner->learned.values.cost[node] / 1024;
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            value[node][k] = (REAL)planner->learned.values.value[node][k] / 256;
        }
    }
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        steerings[k] = steering_degrees[k] * (REAL)0.017453292519943295;
    }
    ground = planner->learned.ground;
    turn = planner->learned.turn;
    last_node = planner->node;
    last_action = planner->action;
    last_pose = planner->pose;
    last_expected = (motion){{planner->expected.forward, planner->expected.sideways, planner->expected.turn, 1}};
    memcpy(last_angle, planner->angle, sizeof last_angle);
}

/* --- what an action does --- */

static void solve_3(REAL a[3][4]) {
    for (int32_t i = 0; i < 3; i++) {
        for (int32_t r = i + 1; r < 3; r++) {
            REAL factor = a[r][i] / a[i][i];
            for (int32_t c = i; c < 4; c++) {
                a[r][c] -= factor * a[i][c];
            }
        }
    }
    for (int32_t i = 2; i >= 0; i--) {
        for (int32_t c = i + 1; c < 3; c++) {
            a[i][3] -= a[i][c] * a[c][3];
        }
        a[i][3] /= a[i][i];
    }
}

/* The motion of least power, by Newton's method with friction that is softened less and less. */
static motion quasi_static(int32_t action) {
    REAL q[3] = {0, 0, 0};
    REAL softness = 2 * (REAL)footing.travel;
    for (int32_t iteration = 0; footing.count > 0 && iteration < 5; iteration++) {
        REAL a[3][4] = {
            {(REAL)1e-6, 0, 0, -(REAL)footing.pull_x}, {0, (REAL)1e-6, 0, -(REAL)footing.pull_y}, {0, 0, 0, 0}};
        for (int32_t i = 0; i < footing.count; i++) {
            REAL x = footing.x[i], y = footing.y[i];
            REAL slip[2] = {q[0] - q[2] * y, q[1] + q[2] * x};
            for (int32_t k = 0; k < planner->planned.count; k++) {
                REAL share = planner->planned.level[action][k] - 1;
                slip[0] += share * (REAL)footing.shift_x[planner->planned.actuator[k]][i];
                slip[1] += share * (REAL)footing.shift_y[planner->planned.actuator[k]][i];
            }
            REAL length = sqrt(slip[0] * slip[0] + slip[1] * slip[1] + softness * softness);
            REAL jacobian[2][3] = {{1, 0, -y}, {0, 1, x}};
            for (int32_t d = 0; d < 2; d++) {
                for (int32_t r = 0; r < 3; r++) {
                    a[r][3] += (REAL)footing.load[i] * jacobian[d][r] * slip[d] / length;
                    for (int32_t e = 0; e < 2; e++) {
                        REAL bend = ((d == e ? 1 : 0) - slip[d] * slip[e] / (length * length)) / length;
                        for (int32_t c = 0; c < 3; c++) {
                            a[r][c] += (REAL)footing.load[i] * jacobian[d][r] * bend * jacobian[e][c];
                        }
                    }
                }
            }
        }
        solve_3(a);
        REAL reach = sqrt(a[0][3] * a[0][3] + a[1][3] * a[1][3] + a[2][3] * a[2][3]);
        REAL scale = reach > (REAL)footing.travel ? (REAL)footing.travel / reach : 1;
        for (int32_t r = 0; r < 3; r++) {
            q[r] -= scale * a[r][3];
        }
        softness *= (REAL)0.4;
    }
    return (motion){{q[0], q[1], q[2], 1}};
}

static REAL squared_distance(const sample *s, const float *angle) {
    REAL sum = 0;
    for (int32_t k = 0; k < JOINTS; k++) {
        REAL difference = (s->angle[k] - (REAL)angle[k]) / (REAL)planner->learned.model.width[k];
        sum += difference * difference;
    }
    return sum;
}

/* `expected` with what was measured of the action round `angle`; *known: weight of the nearest measurements. */
static motion correct(motion expected, const float *angle, int32_t action, REAL *known) {
    REAL wide_weight = 0, narrow_weight = 0;
    motion wide = {{0}}, narrow = {{0}};
    for (int32_t i = 0; i < num_samples; i++) {
        REAL square = samples[i].action == action ? squared_distance(&samples[i], angle) : 4;
        if (square < 4) {
            REAL w = (1 - square / 4) * (1 - square / 4) * (REAL)samples[i].count;
            REAL n = square < 1 ? (1 - square) * (1 - square) * (REAL)samples[i].count : 0;
            wide_weight += w;
            narrow_weight += n;
            for (int32_t k = 0; k < PARTS; k++) {
                wide.part[k] += w * samples[i].difference.part[k];
                narrow.part[k] += n * samples[i].difference.part[k];
            }
        }
    }
    for (int32_t k = 0; k < PARTS; k++) {
        REAL general = wide.part[k] / ((REAL)planner->learned.model.prior_weight + wide_weight);
        expected.part[k] += (WIDE_WEIGHT * general + narrow.part[k]) / (WIDE_WEIGHT + narrow_weight);
    }
    *known = narrow_weight;
    return expected;
}

static void look(const float *angle) {
    float joint_angle[LH_MAX_ACTUATORS];
    memcpy(joint_angle, planner->joint_angle, sizeof joint_angle);
    lh_planned_set_angles(&planner->planned, angle, joint_angle);
    lh_rest_find(&planner->robot, joint_angle, up, &rest);
    lh_footing_find(&planner->robot, joint_angle, &rest, up, planner->planned.travel, FRICTION, &footing);
}

/* --- values --- */

static REAL steering_cost(REAL error) {
    REAL size = fabs(error);
    REAL bent = size < STEERING_BEND ? size * size / STEERING_BEND : 2 * size - STEERING_BEND;
    return (REAL)planner->config.steering * bent;
}

static REAL steering_of(REAL heading, REAL lateral) {
    return heading + (REAL)LH_STEERING_GAIN * lateral;
}

static REAL standing_cost(REAL margin) {
    REAL lacking = 1 - margin / (SAFE_MARGIN * (REAL)lh_robot_scale(&planner->robot));
    lacking = lacking < 0 ? 0 : lacking > 3 ? 3 : lacking;
    return (REAL)planner->task.reward.stability * exp(-margin) + (REAL)planner->config.unsafe * lacking;
}

static REAL value_at(int32_t node, REAL steering) {
    int32_t k = 0;
    while (k < LH_STEERINGS - 2 && steering >= steerings[k + 1]) {
        k++;
    }
    REAL share = (steering - steerings[k]) / (steerings[k + 1] - steerings[k]);
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    return value[node][k] + share * (value[node][k + 1] - value[node][k]);
}

/* Interpolated between the eight corners; the cost of standing there into *standing. */
static REAL value_of_posture(const float *angle, REAL steering, REAL *standing) {
    const lh_posture_values *lattice = &planner->learned.values;
    REAL sum = 0;
    *standing = 0;
    for (int32_t corner = 0; corner < 8; corner++) {
        REAL weight = 1;
        int32_t node = 0;
        for (int32_t k = 0; k < JOINTS; k++) {
            REAL last = (REAL)(lattice->count[k] - 1);
            REAL scaled = ((REAL)angle[k] - (REAL)lattice->low[k]) / (REAL)lattice->spacing[k];
            scaled = scaled < 0 ? 0 : scaled > last ? last : scaled;
            int32_t place = (int32_t)scaled < lattice->count[k] - 1 ? (int32_t)scaled : lattice->count[k] - 2;
            REAL share = scaled - (REAL)place;
            int32_t next = corner >> k & 1;
            weight *= next ? share : 1 - share;
            node = node * lattice->count[k] + place + next;
        }
        sum += weight * value_at(node, steering);
        *standing += weight * cost[node];
    }
    return sum;
}

/* The reward of a motion but for the cost of the posture; the course becomes that after it. */
static REAL advance(const motion *m, REAL *heading, REAL *lateral) {
    REAL along = m->part[0] * cos(*heading) - m->part[1] * sin(*heading);
    REAL across = m->part[0] * sin(*heading) + m->part[1] * cos(*heading);
    REAL half = m->part[2] / 2;
    *lateral += across + half * along;
    *heading += m->part[2];
    return (REAL)planner->task.reward.forward * (along - half * across) -
           (REAL)planner->task.reward.sideways * fabs(m->part[1]) - steering_cost(steering_of(*heading, *lateral));
}

static void back_up(int32_t node) {
    const REAL discount = planner->config.discount_rate;
    float angle[JOINTS];
    lh_posture_angles(&planner->learned.values, node, angle);
    look(angle);
    cost[node] = standing_cost(rest.margin);
    REAL best[LH_STEERINGS];
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        best[k] = -INFINITY;
    }
    for (int32_t a = 0; a < planner->planned.num_actions; a++) {
        int32_t next =
            lh_posture_neighbour(&planner->learned.values, node, lh_planned_joint_levels(&planner->planned, a));
        if (next == LH_NO_NODE || a == lh_planned_still(&planner->planned)) {
            continue;
        }
        REAL known;
        motion m = correct(quasi_static(a), angle, a, &known);
        next = m.part[3] < JAMMED ? node : next;
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            REAL heading = steerings[k], lateral = 0;
            REAL reward = advance(&m, &heading, &lateral);
            REAL after = steering_of(heading, lateral);
            REAL later = 2 * after - steerings[k];
            REAL again = reward + steering_cost(after) - steering_cost(later);
            REAL worth =
                reward + discount * again - cost[next] * (1 + discount) + discount * discount * value_at(next, later);
            best[k] = worth > best[k] ? worth : best[k];
        }
    }
    memcpy(value[node], best, sizeof best);
}

/* --- a decision --- */

static void move(const float *angle, int32_t action, REAL moved, float *next) {
    const int8_t *level = lh_planned_joint_levels(&planner->planned, action);
    for (int32_t k = 0; k < JOINTS; k++) {
        int32_t actuator = planner->planned.actuator[planner->planned.num_crawlers + k];
        next[k] = angle[k] + (float)moved * planner->planned.travel[actuator] * (float)(level[k] - 1);
    }
}

/* Where the robot is looked at. */
static option consider(const float *angle, REAL heading, REAL lateral, int32_t action) {
    option o = {.action = action, .heading = heading, .lateral = lateral};
    REAL known, standing;
    motion m = correct(quasi_static(action), angle, action, &known);
    o.reward = advance(&m, &o.heading, &o.lateral);
    move(angle, action, m.part[3], o.angle);
    REAL then = value_of_posture(o.angle, steering_of(o.heading, o.lateral), &standing);
    o.reward -= standing;
    o.value = o.reward + (REAL)planner->config.discount_rate * then;
    return o;
}

static int falling(const void *a, const void *b) {
    const option *x = a, *y = b;
    return x->value < y->value ? 1 : x->value > y->value ? -1 : x->action - y->action;
}

static int32_t all_options(const float *angle, REAL heading, REAL lateral, option *options) {
    int32_t count = 0;
    look(angle);
    for (int32_t a = 0; a < planner->planned.num_actions; a++) {
        if (lh_planned_allows(&planner->planned, angle, a)) {
            options[count++] = consider(angle, heading, lateral, a);
        }
    }
    qsort(options, (size_t)count, sizeof *options, falling);
    return count;
}

static int32_t choose(const float *angle, REAL heading, REAL lateral) {
    static option options[LH_PLANNED_ACTIONS], further[LH_PLANNED_ACTIONS];
    int32_t count = all_options(angle, heading, lateral, options);
    int32_t best = 0;
    for (int32_t i = 0; i < count && i < planner->config.candidates; i++) {
        all_options(options[i].angle, options[i].heading, options[i].lateral, further);
        options[i].value = options[i].reward + (REAL)planner->config.discount_rate * further[0].value;
        best = options[i].value > options[best].value ? i : best;
    }
    return options[best].action;
}

/* What the step under way did. */
static motion measure(const lh_observed *observed, const float *angle) {
    REAL dx = observed->pose.x - last_pose.x, dy = observed->pose.y - last_pose.y;
    REAL turned = lh_wrap_angle(observed->pose.heading - last_pose.heading);
    REAL midway = (REAL)last_pose.heading + turned / 2;
    float goal[JOINTS];
    move(last_angle, last_action, 1, goal);
    REAL commanded = 0, achieved = 0;
    for (int32_t k = 0; k < JOINTS; k++) {
        REAL from = last_angle[k];
        REAL to = lh_clip(goal[k], planner->planned.low[k], planner->planned.high[k]);
        commanded += fabs(to - from);
        achieved += to > from ? (REAL)angle[k] - from : to < from ? from - (REAL)angle[k] : 0;
    }
    REAL moved = commanded > (REAL)0.02 ? achieved / commanded : 1;
    moved = moved < 0 ? 0 : moved > 1 ? 1 : moved;
    return (motion){{cos(midway) * dx + sin(midway) * dy, cos(midway) * dy - sin(midway) * dx, turned, moved}};
}

/* The sample that takes a measurement of the step under way: the nearest of the same action within 0.3 widths, else a
 * new one, in the place of the oldest where there is no room. */
static sample *place_of(void) {
    sample *found = NULL;
    REAL least = SAME_WIDTHS * SAME_WIDTHS;
    for (int32_t i = 0; i < num_samples; i++) {
        REAL square = squared_distance(&samples[i], last_angle);
        if (samples[i].action == last_action && square < least) {
            least = square;
            found = &samples[i];
        }
    }
    if (found == NULL) {
        found = &samples[num_samples];
        for (int32_t i = 0; num_samples == LH_MAX_SAMPLES && i < num_samples; i++) {
            found = i == 0 || samples[i].updated < found->updated ? &samples[i] : found;
        }
        num_samples += num_samples < LH_MAX_SAMPLES;
        *found = (sample){.action = last_action};
    }
    return found;
}

static void learn(const lh_observed *observed, const float *angle, int32_t now) {
    motion measured = measure(observed, angle);
    sample *place = place_of();
    REAL share = (REAL)1 / (REAL)(place->count + 1);
    for (int32_t k = 0; k < JOINTS; k++) {
        place->angle[k] += share * ((REAL)last_angle[k] - place->angle[k]);
    }
    for (int32_t k = 0; k < PARTS; k++) {
        REAL difference = measured.part[k] - last_expected.part[k];
        place->difference.part[k] += share * (difference - place->difference.part[k]);
    }
    place->count += place->count < LH_SAMPLE_COUNT_MAX;
    place->updated = now;
}

/* The slope of the ground by how the body lies on it, and the vertical seen from there. */
static void watch_ground(const lh_observed *observed) {
    const lh_vec3 vertical = {0, 0, 1};
    lh_rest_find(&planner->robot, observed->joint_angle, vertical, &rest);
    lh_vec3 normal = lh_quat_rotate(observed->attitude, rest.normal);
    lh_vec3 moved = lh_vec3_add(ground, lh_vec3_scale(lh_vec3_sub(normal, ground), GROUND_RATE));
    ground = lh_vec3_scale(moved, 1.0f / lh_vec3_norm(moved));
    float direction = observed->pose.heading - observed->heading_error;
    up = lh_quat_rotate(lh_rest_upright(lh_quat_rotate(lh_quat_about(vertical, -direction), ground)), vertical);
}

static int32_t decide(int32_t k) {
    const lh_observed *observed = &given->observed[k];
    float angle[JOINTS];
    lh_planned_angles(&planner->planned, observed->joint_angle, angle);
    learn(observed, angle, planner->learned.decisions + k);
    watch_ground(observed);
    lh_cell cell;
    lh_posture_cell(&planner->learned.values, angle, &cell);
    int32_t node = lh_posture_nearest(&cell);
    back_up(last_node);
    back_up(node);
    for (int32_t i = 0; i < planner->config.backups; i++) {
        back_up(turn);
        turn = turn + 1 < planner->learned.values.num_nodes ? turn + 1 : 0;
    }
    int32_t action = choose(angle, observed->heading_error, observed->lateral_error);
    last_action = given->executed[k];
    look(angle);
    last_expected = quasi_static(last_action);
    last_pose = observed->pose;
    last_node = node;
    memcpy(last_angle, angle, sizeof last_angle);
    return action;
}

const planner_method METHOD = {begin, decide};
