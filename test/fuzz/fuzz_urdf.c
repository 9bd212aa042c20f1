/* A robot file of any bytes is refused with a text, or gives a robot that the library accepts and can step. */
#include <math.h>
#include <string.h>

#include "convert_robot.h"
#include "robot_file.h"
#include "sound.h"

static void step(const lh_robot *robot) {
    static lh_controller controller;
    lh_controlled controlled = {.count = 1, .index = {0}};
    const lh_config config = lh_config_default();
    FUZZ_EXPECT(lh_controller_init(&controller, &config, robot, &controlled) == LH_OK);
    const lh_state state = {.num_actuators = robot->num_actuators, .orientation = {1, 0, 0, 0}};
    fuzz_step(&controller, &state);
}

static bool is_unit(const double *v, int count) {
    double square = 0;
    for (int i = 0; i < count; i++) {
        square += v[i] * v[i];
    }
    return fabs(square - 1) < 1e-6;
}

static bool is_near(const double v[3]) {
    return fabs(v[0]) < 1000 && fabs(v[1]) < 1000 && fabs(v[2]) < 1000; /* so they are numbers */
}

/* What robot_description.h says of it. */
static void expect_whole(const robot_description *r) {
    FUZZ_EXPECT(r->num_actuators > ROBOT_CRAWLERS && r->num_actuators <= ROBOT_MAX_ACTUATORS);
    FUZZ_EXPECT(r->num_bodies == r->num_actuators + 1);
    for (int b = 0; b < r->num_bodies; b++) {
        const robot_body *body = &r->bodies[b];
        FUZZ_EXPECT(body->parent < b && (body->parent >= 0) == (b > 0));
        FUZZ_EXPECT(is_unit(body->axis, 3) && is_unit(body->joint.rotation, 4) && is_near(body->joint.position));
        FUZZ_EXPECT(body->mass > 0 && is_near(body->centre) && body->inertia[0][0] > 0);
        for (int a = 0; a < r->num_bodies; a++) {
            FUZZ_EXPECT(r->may_meet[a][b] == r->may_meet[b][a] && !r->may_meet[a][a]);
        }
    }
    for (int a = 0; a < r->num_actuators; a++) {
        const robot_actuator *actuator = &r->actuators[a];
        FUZZ_EXPECT(actuator->effort > 0 && actuator->speed > 0);
        FUZZ_EXPECT(actuator->lower <= actuator->home && actuator->home <= actuator->upper);
    }
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        const robot_crawler *crawler = &r->crawlers[c];
        FUZZ_EXPECT(is_unit(crawler->axis, 3) && crawler->axis[1] > 0.9 && crawler->width > 0);
        FUZZ_EXPECT(crawler->radius > 0 && crawler->length >= 2 * crawler->radius);
    }
    FUZZ_EXPECT(r->num_tips > 0 && r->num_tips <= r->num_shapes && r->num_shapes <= ROBOT_MAX_SHAPES);
    for (int i = 0; i < r->num_shapes; i++) {
        const robot_shape *shape = &r->shapes[i];
        FUZZ_EXPECT(shape->body < r->num_bodies && is_near(shape->pose.position) && is_unit(shape->pose.rotation, 4));
        FUZZ_EXPECT(shape->half_size[0] > 0 && shape->half_size[1] > 0 && shape->half_size[2] > 0);
    }
    FUZZ_EXPECT(r->num_supports >= 3 && r->num_supports <= ROBOT_MAX_SUPPORTS);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    robot_description read;
    robot_report report;
    if (robot_file_read(fuzz_file(data, size), NULL, &read, &report)) {
        lh_robot robot;
        char error[ERROR_LENGTH] = "";
        FUZZ_EXPECT(report.num_faults == 0 && convert_robot(&read, &robot, error));
        expect_whole(&read);
        step(&robot);
    } else {
        FUZZ_EXPECT(report.num_faults > 0);
    }
    for (int i = 0; i < report.num_faults; i++) {
        FUZZ_EXPECT(report.faults[i][0] != '\0' && strchr(report.faults[i], '\n') == NULL);
    }
    robot_report_free(&report);
    return 0;
}
