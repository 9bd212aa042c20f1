/* Compile-time capacities. Every struct of the library has its full size by them; nothing is allocated.
 * Define any of them on the command line to make the library smaller or larger; all sources and callers must agree.
 *
 * At most so many bytes, with S = LH_UNIT_SLOTS, U = LH_MAX_UNITS, C = LH_COLUMN_SLOTS, A = LH_MAX_ACTUATORS, 3 or
 * more, L = LH_MAX_LINKS, P = LH_MAX_SUPPORTS, H = LH_MAX_SHAPES, W = LH_MAX_WAYPOINTS, N = LH_MAX_SAMPLES,
 * M = LH_MAX_POSTURES, K = LH_MAX_PLANNED and B = LH_PLANNED_ACTIONS:
 *
 *     lh_network         8 + 4 S (2 A + 4)
 *     lh_action_scratch  4 S (3 A + 6) + 4 U C
 *     lh_q_learning      lh_network + lh_action_scratch + 4 LH_MAX_ACTIONS + 4 A + 136
 *     lh_planner_learned 22 N + 20 M + 120
 *     lh_planner         lh_planner_learned + (52 + K) B + 8 A P + 24 A + 64 L + 36 P + 8 W + 8 K + 736
 *     lh_learner         the larger of lh_q_learning and lh_planner, + 12
 *     lh_task            20 A + 64 L + 20 P + 8 W + 192
 *     lh_monitor         14 A + 4 L + 48 H + 228
 *     lh_controller      lh_learner + lh_task + lh_monitor
 *
 * and on the stack, where lh_controller_step takes the most, about 1750 + 70 P.
 *
 * The time of a decision grows with the number of joint actions, and with S or N. Only the actions, the samples and the
 * postures that a robot has are computed with; N and M decide what a planner learns, all else only what fits. */
#ifndef LIMPHOME_CAPACITY_H
#define LIMPHOME_CAPACITY_H

#ifndef LH_MAX_ACTUATORS
#define LH_MAX_ACTUATORS 8 /* crawlers and arm joints of the robot */
#endif
#ifndef LH_MAX_UNITS
#define LH_MAX_UNITS 64 /* basis functions of the network */
#endif
#ifndef LH_MAX_LINKS
#define LH_MAX_LINKS (LH_MAX_ACTUATORS + 1) /* rigid bodies of the robot */
#endif
#ifndef LH_MAX_SUPPORTS
#define LH_MAX_SUPPORTS 12 /* points on which the robot can stand */
#endif
#ifndef LH_MAX_SHAPES
#define LH_MAX_SHAPES 32 /* parts of the robot that the monitor keeps apart */
#endif
#ifndef LH_MAX_WAYPOINTS
#define LH_MAX_WAYPOINTS 8 /* of a path */
#endif
#ifndef LH_MAX_ACTIONS
#define LH_MAX_ACTIONS 6561 /* joint actions, LH_ACTION_LEVELS ^ LH_MAX_ACTUATORS */
#endif
#ifndef LH_MAX_SAMPLES
#define LH_MAX_SAMPLES 960 /* measured motions that the planner keeps, a multiple of 16 */
#endif
#ifndef LH_MAX_POSTURES
#define LH_MAX_POSTURES 1200 /* postures of the arm for which it plans */
#endif
#ifndef LH_MAX_PLANNED
#define LH_MAX_PLANNED 5 /* actuators it plans with: LH_PLANNED_JOINTS joints and two crawlers; 4: one crawler */
#endif

#define LH_PLANNED_JOINTS 3
#define LH_PLANNED_ACTIONS (LH_MAX_PLANNED == 4 ? 81 : 243) /* LH_ACTION_LEVELS ^ LH_MAX_PLANNED */

#define LH_ACTION_LEVELS 3                         /* reverse, still, forward: Table 1 */
#define LH_MAX_INPUTS (2 * LH_MAX_ACTUATORS + 2)   /* states and actions of all actuators, roll, pitch */
#define LH_MAX_STATE_INPUTS (LH_MAX_ACTUATORS + 2) /* states of all actuators, roll, pitch */

/* Units are computed this many at a time, and sums over units taken in this many parts: loops of constant length become
 * vector code. Part of the definition of the results, so equal on every platform. */
#define LH_LANES 8
#define LH_UNIT_SLOTS ((LH_MAX_UNITS + LH_LANES - 1) / LH_LANES * LH_LANES)

/* Joint actions are computed in blocks of three actuators (action_values.c), also where there are fewer. */
#define LH_FACTOR_SLOTS (LH_MAX_ACTUATORS < 3 ? 3 : LH_MAX_ACTUATORS)
/* The nine columns of a block, with room for whole vectors on processors that have them. */
#if defined(__x86_64__) || defined(__aarch64__)
#define LH_COLUMN_SLOTS 16
#else
#define LH_COLUMN_SLOTS 9
#endif

#endif
