/* The robot of config/crawler.urdf as the library's structs, and states of it. */
#ifndef LIMPHOME_TEST_CRAWLER_H
#define LIMPHOME_TEST_CRAWLER_H

#include "limphome/limphome.h"

/* Actuators left and right crawler, swing, boom, arm; supports the four of the crawlers, then the tip. */
lh_robot crawler_robot(void);

/* Belts, arm, cabin, boom and chassis; the first of them if the library has no room for all. */
lh_shapes crawler_shapes(void);

/* As in the paper with the left crawler failed: right crawler, swing, boom, arm. */
/* The same with all lengths by that factor. */
lh_robot scaled_robot(const lh_robot *robot, float factor);

lh_controlled crawler_controlled(void);

/* Level at (x, y), arm in its initial pose, no torque. */
lh_state crawler_state(float x, float y, float heading);

#endif
