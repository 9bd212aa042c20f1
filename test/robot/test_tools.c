/* What tools write is accepted, and is the robot that is meant. */
#include <math.h>

#include "edited.h"

#define PI 3.14159265358979323846

static struct edited e; /* large for a stack frame */

static void read_plain(robot_description *robot) {
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, robot));
}

/* The crawler with `from` replaced by `to`, as read. */
static void read_edited(const char *from, const char *to) {
    edited_begin(&e);
    edited_replace(&e, from, to);
    edited_read(&e);
}

static void expect_numbers(const double *a, const double *b, int count) {
    for (int i = 0; i < count; i++) {
        ck_assert_double_eq_tol(a[i], b[i], 1e-12);
    }
}

static void expect_pose(const robot_pose *a, const robot_pose *b) {
    expect_numbers(a->position, b->position, 3);
    expect_numbers(a->rotation, b->rotation, 4);
}

/* Names and file aside. */
static void expect_same(const robot_description *a, const robot_description *b) {
    ck_assert_int_eq(a->num_bodies, b->num_bodies);
    ck_assert_int_eq(a->num_shapes, b->num_shapes);
    ck_assert_int_eq(a->num_supports, b->num_supports);
    for (int i = 0; i < a->num_bodies; i++) {
        ck_assert_int_eq(a->bodies[i].parent, b->bodies[i].parent);
        expect_pose(&a->bodies[i].joint, &b->bodies[i].joint);
        expect_numbers(a->bodies[i].axis, b->bodies[i].axis, 3);
        expect_numbers(&a->bodies[i].mass, &b->bodies[i].mass, 1);
        expect_numbers(a->bodies[i].centre, b->bodies[i].centre, 3);
        expect_numbers(&a->bodies[i].inertia[0][0], &b->bodies[i].inertia[0][0], 9);
    }
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        expect_numbers(a->crawlers[i].centre, b->crawlers[i].centre, 3);
        expect_numbers(a->crawlers[i].axis, b->crawlers[i].axis, 3);
    }
    for (int i = 0; i < a->num_shapes; i++) {
        ck_assert_int_eq(a->shapes[i].body, b->shapes[i].body);
        expect_pose(&a->shapes[i].pose, &b->shapes[i].pose);
        expect_numbers(a->shapes[i].half_size, b->shapes[i].half_size, 3);
    }
    for (int i = 0; i < a->num_supports; i++) {
        expect_numbers(a->supports[i].point, b->supports[i].point, 3);
    }
    ck_assert_mem_eq(a->may_meet, b->may_meet, sizeof a->may_meet);
}

/* The base frame where tools put it: a frame without mass at the root, anywhere, and however it is turned. */
START_TEST(the_body_frame_follows_from_the_crawlers) {
    static const char *const origins[] = {"xyz='0 0 0'", "xyz='0.3 -0.2 0.4'", "rpy='0 0 1.5'", "rpy='0 0 3.1'",
                                          "xyz='1 2 -3' rpy='0 0 -2'"};
    robot_description plain;
    read_plain(&plain);
    char frame[200];
    snprintf(frame, sizeof frame,
             "<link name='world'/><joint name='w' type='fixed'><parent link='world'/><child link='base'/><origin "
             "%s/></joint><link name=\"base\">",
             origins[_i]);
    read_edited("<link name=\"base\">", frame);
    if (_i == 0) {
        edited_expect_good(&e);
        ck_assert_int_eq(e.report.num_notices, 0);
    } else {
        edited_expect_notice(&e, "the body frame, on the ground midway between the crawlers, lies at");
    }
    ck_assert_str_eq(e.robot.bodies[0].name, "world");
    expect_same(&e.robot, &plain);
    edited_end(&e);
}
END_TEST

START_TEST(a_sprocket_that_turns_the_other_way_is_turned) {
    robot_description plain;
    read_plain(&plain);
    read_edited("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 -1 0\"/>");
    edited_expect_notice(&e, "<joint name=\"left_crawler\">: its axis points to the right");
    expect_same(&e.robot, &plain);
    edited_end(&e);
}
END_TEST

/* 126 links, as of a robot whose every bolt is a link. */
START_TEST(links_are_counted_after_merging) {
    edited_begin(&e);
    static char bolts[40000];
    size_t length = 0;
    for (int i = 0; i < 120; i++) {
        length += (size_t)snprintf(
            bolts + length, sizeof bolts - length,
            "<link name='b%d'><inertial><mass value='0.1'/><inertia ixx='1e-5' iyy='1e-5' izz='1e-5' ixy='0' ixz='0' "
            "iyz='0'/></inertial></link><joint name='b%d' type='fixed'><parent link='%s'/><child link='b%d'/></joint>",
            i, i, i % 2 == 0 ? "base" : "arm", i);
    }
    snprintf(bolts + length, sizeof bolts - length, "<limphome>");
    edited_replace(&e, "<limphome>", bolts);
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_int_eq(e.robot.num_bodies, 6);
    ck_assert_double_eq_tol(e.robot.bodies[0].mass, 498 + 60 * 0.1, 1e-9);
    ck_assert_double_eq_tol(e.robot.bodies[5].mass, 35 + 60 * 0.1, 1e-9);
    edited_end(&e);
}
END_TEST

START_TEST(a_continuous_arm_joint_may_turn_once_round) {
    read_edited("<joint name=\"swing\" type=\"revolute\">", "<joint name=\"swing\" type=\"continuous\">");
    edited_expect_notice(&e, "<arm joint=\"swing\">: is continuous; limited to -3.142 to 3.142 rad");
    ck_assert_double_eq(e.robot.actuators[2].upper, PI);
    edited_end(&e);
    edited_begin(&e);
    edited_replace(&e, "<joint name=\"swing\" type=\"revolute\">", "<joint name=\"swing\" type=\"continuous\">");
    edited_replace(&e, "<arm joint=\"swing\"", "<arm joint=\"swing\" lower=\"-1\" upper=\"2\"");
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_int_eq(e.report.num_notices, 0);
    ck_assert_double_eq(e.robot.actuators[2].lower, -1);
    ck_assert_double_eq(e.robot.actuators[2].upper, 2);
    edited_end(&e);
}
END_TEST

/* Tools write limits of 0, or none. */
START_TEST(the_extension_gives_what_the_joint_lacks) {
    edited_begin(&e);
    edited_replace(&e, "<limit lower=\"-0.6\" upper=\"1.2\" effort=\"6000\" velocity=\"1\"/>",
                   "<limit lower=\"-0.6\" upper=\"1.2\" effort=\"0\" velocity=\"0\"/>");
    edited_replace(&e, "<arm joint=\"boom\"", "<arm joint=\"boom\" effort=\"77\" velocity=\"2\"");
    edited_replace(&e, "<limit effort=\"1000\" velocity=\"5\"/>", "");
    edited_replace(&e, "<crawler joint=\"left_crawler\"",
                   "<crawler joint=\"left_crawler\" effort=\"88\" velocity=\"3\"");
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_double_eq(e.robot.actuators[3].effort, 77);
    ck_assert_double_eq(e.robot.actuators[3].speed, 2);
    ck_assert_double_eq(e.robot.actuators[0].effort, 88);
    ck_assert_double_eq(e.robot.actuators[0].speed, 3);
    edited_end(&e);
}
END_TEST

/* Both crawlers fixed to the base: the sprockets' links are left over as parts of it. */
static void begin_without_sprockets(const char *inertia) {
    edited_begin(&e);
    for (int i = 0; i < 2; i++) {
        const char *side = i == 0 ? "left" : "right";
        char from[100], to[200];
        snprintf(from, sizeof from, "<joint name=\"%s_crawler\" type=\"continuous\">", side);
        snprintf(to, sizeof to, "<joint name=\"%s_crawler\" type=\"fixed\">", side);
        edited_replace(&e, from, to);
        snprintf(from, sizeof from, "<crawler joint=\"%s_crawler\"", side);
        snprintf(to, sizeof to, "<crawler link=\"base\" effort=\"900\" velocity=\"4\"%s", inertia);
        edited_replace(&e, from, to);
    }
}

START_TEST(a_crawler_may_do_without_a_joint) {
    begin_without_sprockets(" inertia=\"4\"");
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_int_eq(e.robot.num_bodies, 6);
    double mass = 0;
    for (int i = 0; i < 6; i++) {
        mass += e.robot.bodies[i].mass;
    }
    ck_assert_double_eq_tol(mass, 945, 1e-9);
    ck_assert_str_eq(e.robot.actuators[1].name, "right_sprocket");
    ck_assert_double_eq(e.robot.actuators[1].effort, 900);
    ck_assert_double_eq(e.robot.bodies[2].joint.position[1], -0.475);
    ck_assert_double_eq(e.robot.bodies[2].axis[1], 1);
    ck_assert_double_eq(e.robot.bodies[2].inertia[1][1], 4);
    edited_end(&e);
    begin_without_sprockets("");
    edited_read(&e);
    edited_expect_notice(&e, "<crawler link=\"base\">: the drive train is given an inertia of 1.53 kg m^2");
    ck_assert_double_eq_tol(e.robot.bodies[1].inertia[1][1], 0.05 * 945 * 0.18 * 0.18, 1e-9);
    edited_end(&e);
}
END_TEST

#define CAMERA(type, joint)                                                                                     \
    "<link name='camera'><inertial><mass value='2'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' " \
    "iyz='0'/></inertial><collision><origin xyz='0.1 0 0'/><geometry><sphere radius='0.02'/></geometry>"        \
    "</collision></link><joint name='pan' type='" type                                                          \
    "'><parent link='upper_body'/><child link='camera'/>"                                                       \
    "<origin xyz='0 0 1'/><axis xyz='0 0 1'/>" joint "</joint>"

/* The camera's ball, in the frame of the upper body. */
static void expect_camera(double x, double y, double z) {
    const robot_shape *ball = e.robot.shapes;
    while (strcmp(ball->name, "camera") != 0) {
        ball++;
        ck_assert(ball < e.robot.shapes + e.robot.num_shapes);
    }
    ck_assert_int_eq(ball->body, 3);
    ck_assert_double_eq_tol(ball->pose.position[0], x, 1e-12);
    ck_assert_double_eq_tol(ball->pose.position[1], y, 1e-12);
    ck_assert_double_eq_tol(ball->pose.position[2], z, 1e-12);
}

static const struct {
    const char *camera, *hold, *notice; /* NULL: none */
    double x, y, z;
} holds[] = {
    {CAMERA("continuous", ""), "", "<joint name=\"pan\">: moves, but is no actuator of <limphome>; held at 0 rad", 0.1,
     0, 1},
    {CAMERA("continuous", ""), "<hold joint='pan' home='1.5707963267948966'/>", NULL, 0, 0.1, 1},
    {CAMERA("prismatic", "<limit lower='0.25' upper='0.5'/>"), "", "held at 0.25 m", 0.1, 0, 1.25},
    {CAMERA("prismatic", "<limit lower='0.25' upper='0.5'/>"), "<hold joint='pan' home='0.5'/>", NULL, 0.1, 0, 1.5},
    {CAMERA("floating", ""), "", "held where it is at rest", 0.1, 0, 1},
    {CAMERA("revolute",
            "<limit lower='-2' upper='2'/><mimic joint='arm' multiplier='-1' offset='0.0707963267948966'/>"),
     "", "<mimic joint=\"arm\">: is not followed; held at 1.571 rad", 0, 0.1, 1},
};

START_TEST(what_moves_but_is_no_actuator_is_held) {
    edited_begin(&e);
    char camera[1000];
    snprintf(camera, sizeof camera, "%s<limphome>%s", holds[_i].camera, holds[_i].hold);
    edited_replace(&e, "<limphome>", camera);
    edited_read(&e);
    if (holds[_i].notice != NULL) {
        edited_expect_notice(&e, holds[_i].notice);
    } else {
        edited_expect_good(&e);
        ck_assert_int_eq(e.report.num_notices, 0);
    }
    ck_assert_int_eq(e.robot.num_bodies, 6);
    ck_assert_double_eq_tol(e.robot.bodies[3].mass, 352, 1e-9);
    expect_camera(holds[_i].x, holds[_i].y, holds[_i].z);
    edited_end(&e);
}
END_TEST

static const struct {
    const char *from, *to, *words;
} refusals[] = {
    {"<limphome>", "<limphome><hold joint='boom' home='0'/>", "<hold joint=\"boom\">: is an actuator"},
    {"<limphome>", "<limphome><hold joint='lost' home='0'/>", "<hold joint=\"lost\">: there is no such joint"},
    {"<limphome>", CAMERA("fixed", "") "<limphome><hold joint='pan' home='0'/>", "does not turn or slide"},
    {"<limphome>", CAMERA("continuous", "") "<limphome><hold joint='pan'/>", "<hold joint=\"pan\">: needs home"},
    {"<limphome>", CAMERA("continuous", "") "<limphome><hold joint='pan' home='1'/><hold joint='pan' home='1'/>",
     "is held already"},
    {"<limphome>", CAMERA("revolute", "<limit lower='1' upper='2'/>") "<limphome><hold joint='pan' home='0'/>",
     "<hold home=\"0\">: must lie within the limits of the joint, 1 to 2"},
    {"<limphome>", CAMERA("continuous", "<mimic joint='pan'/>") "<limphome>",
     "follows a joint that in the end follows it"},
    {"<limphome>", CAMERA("continuous", "<mimic joint='x'/>") "<limphome>",
     "<mimic joint=\"x\">: there is no such joint"},
    {"<limphome>", "<limphome><no_contact link1='base' link2='x'/>", "<no_contact link2=\"x\">: there is no such link"},
    {"<limphome>", "<limphome><inertial link='x' mass='1' size='1 1 1'/>",
     "<inertial link=\"x\">: there is no such link"},
    {"<limphome>", "<limphome><inertial link='boom' mass='1' size='1 0 1'/>",
     "<inertial size=\"1 0 1\">: must be three"},
    {"<limphome>",
     "<limphome><inertial link='boom' mass='10' size='1 1 1'/><inertial link='boom' mass='10' size='1 1 1'/>",
     "<inertial link=\"boom\">: is given twice"},
    {"<limphome>", "<limphome self_contact='no'>", "<limphome self_contact=\"no\">: must be true or false"},
    {"<crawler joint=\"left_crawler\"", "<crawler link=\"arm\" effort=\"1\" velocity=\"1\"",
     "moves with the arm or a sprocket"},
    {"<crawler joint=\"left_crawler\"", "<crawler link=\"base\" effort=\"1\"",
     "<crawler link=\"base\">: needs velocity"},
};

START_TEST(bad_extensions_are_refused) {
    read_edited(refusals[_i].from, refusals[_i].to);
    edited_expect_fault(&e, refusals[_i].words);
    edited_end(&e);
}
END_TEST

/* Without a joint to tell it, what is forward follows from left and right alone. */
START_TEST(crawlers_without_joints_tell_what_is_forward) {
    begin_without_sprockets("");
    edited_replace(&e, "xyz=\"0 0.475 0.18\" length", "xyz=\"0 -1.475 0.18\" length");
    edited_read(&e);
    edited_expect_notice(&e, "turned by -180 degrees");
    edited_expect_notice(&e, "<crawler link=\"base\">: lies to the right");
    ck_assert_double_eq_tol(e.robot.crawlers[0].centre[1], 0.5, 1e-12);
    ck_assert_double_eq_tol(e.robot.bodies[1].joint.position[1], 0.5, 1e-12);
    ck_assert_double_eq_tol(e.robot.bodies[1].axis[1], 1, 1e-12);
    edited_end(&e);
}
END_TEST

/* In place of what stands in the link, good or bad. */
START_TEST(the_extension_may_give_a_link_its_inertia) {
    edited_begin(&e);
    edited_replace(&e, "<mass value=\"60\"/>", "<mass value=\"heavy\"/>");
    edited_replace(&e, "<limphome>", "<limphome><inertial link='boom' mass='12' xyz='0.5 0 0' size='1 0.2 0.1'/>");
    edited_read(&e);
    edited_expect_good(&e);
    const robot_body *boom = &e.robot.bodies[4];
    ck_assert_double_eq_tol(boom->mass, 12, 1e-12);
    ck_assert_double_eq_tol(boom->centre[0], 0.5, 1e-12);
    ck_assert_double_eq_tol(boom->inertia[0][0], 0.04 + 0.01, 1e-12);
    ck_assert_double_eq_tol(boom->inertia[1][1], 1 + 0.01, 1e-12);
    ck_assert_double_eq_tol(boom->inertia[2][2], 1 + 0.04, 1e-12);
    edited_end(&e);
}
END_TEST

/* Its shapes and their meshes are not even looked at. */
START_TEST(a_link_may_touch_nothing) {
    edited_begin(&e);
    edited_replace(&e, "<sphere radius=\"0.08\"/>", "<mesh filename='none.stl'/>");
    edited_replace(&e, "<limphome>", "<limphome><no_contact link1='boom'/>");
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_int_eq(e.report.num_notices, 0);
    for (int i = 0; i < e.robot.num_shapes; i++) {
        ck_assert_int_ne(e.robot.shapes[i].body, 4);
    }
    ck_assert(e.robot.may_meet[0][4]);
    edited_end(&e);
}
END_TEST

START_TEST(contacts_may_be_excepted) {
    read_edited("<limphome>", "<limphome><no_contact link1='base' link2='arm'/>");
    edited_expect_good(&e);
    ck_assert(!e.robot.may_meet[0][5] && !e.robot.may_meet[5][0]);
    ck_assert(e.robot.may_meet[0][4] && e.robot.may_meet[4][0]);
    edited_end(&e);
    read_edited("<limphome>", "<limphome self_contact='false'>");
    edited_expect_good(&e);
    ck_assert(!e.robot.may_meet[0][4]);
    edited_end(&e);
    read_edited("<limphome>", "<limphome self_contact='true'><no_contact link1='boom' link2='arm'/>");
    edited_expect_notice(&e, "<no_contact link1=\"boom\">: excepts nothing");
    ck_assert(e.robot.may_meet[0][4]);
    edited_end(&e);
}
END_TEST

/* A part that is fixed to a body which is possible without it may be anything. */
START_TEST(a_small_part_with_an_inertia_that_no_body_has_is_told_of) {
    read_edited(
        "<limphome>",
        "<link name='bolt'><inertial><mass value='0.1'/><inertia ixx='1e-6' iyy='1e-6' izz='1' ixy='0' ixz='0' "
        "iyz='0'/></inertial></link><joint name='b' type='fixed'><parent link='base'/><child link='bolt'/></joint>"
        "<limphome>");
    edited_expect_notice(&e, "<link name=\"bolt\"> <inertia ixx=\"1e-6\">: has the principal moments");
    edited_end(&e);
}
END_TEST

/* Placeholders that tools leave in small parts. */
START_TEST(a_small_part_may_have_any_inertia) {
    read_edited("<limphome>",
                "<link name='camera'><inertial><mass value='0.03'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
                "iyz='0'/></inertial><collision><geometry><sphere radius='0.02'/></geometry></collision></link><joint "
                "name='c' type='fixed'><parent link='upper_body'/><child link='camera'/></joint><limphome>");
    edited_expect_notice(&e,
                         "is that of a mass 5.77 m from its centre, but nothing of the link is farther than 0.02 m");
    edited_end(&e);
    read_edited("<limphome>",
                "<link name='camera'><inertial><mass value='0.03'/><inertia ixx='9' iyy='9' izz='9' ixy='0' ixz='0' "
                "iyz='0'/></inertial><collision><geometry><sphere radius='0.02'/></geometry></collision></link><joint "
                "name='c' type='fixed'><parent link='upper_body'/><child link='camera'/></joint><limphome>");
    edited_expect_fault(&e, "is that of a mass 17.3 m from its centre");
    edited_end(&e);
}
END_TEST

/* Rotors seen through their gears. */
START_TEST(drive_trains_may_have_any_inertia) {
    read_edited("<mass value=\"1\"/><inertia ixx=\"2\" iyy=\"4\" izz=\"2\"",
                "<mass value=\"1\"/><inertia ixx=\"0.01\" iyy=\"4\" izz=\"0.01\"");
    edited_expect_good(&e);
    ck_assert_int_eq(e.report.num_notices, 0);
    ck_assert_double_eq(e.robot.bodies[1].inertia[1][1], 4);
    edited_end(&e);
}
END_TEST

START_TEST(unknown_elements_are_told_of) {
    read_edited("<inertial>", "<inertail/><inertial>");
    edited_expect_notice(&e, ":12: <link name=\"base\"> <inertail>: is no element of URDF");
    edited_end(&e);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("tools");
    tcase_add_loop_test(cases, the_body_frame_follows_from_the_crawlers, 0, 5);
    tcase_add_test(cases, a_sprocket_that_turns_the_other_way_is_turned);
    tcase_add_test(cases, links_are_counted_after_merging);
    tcase_add_test(cases, a_continuous_arm_joint_may_turn_once_round);
    tcase_add_test(cases, the_extension_gives_what_the_joint_lacks);
    tcase_add_test(cases, a_crawler_may_do_without_a_joint);
    tcase_add_loop_test(cases, what_moves_but_is_no_actuator_is_held, 0, (int)(sizeof holds / sizeof holds[0]));
    tcase_add_loop_test(cases, bad_extensions_are_refused, 0, (int)(sizeof refusals / sizeof refusals[0]));
    tcase_add_test(cases, crawlers_without_joints_tell_what_is_forward);
    tcase_add_test(cases, the_extension_may_give_a_link_its_inertia);
    tcase_add_test(cases, a_link_may_touch_nothing);
    tcase_add_test(cases, contacts_may_be_excepted);
    tcase_add_test(cases, a_small_part_with_an_inertia_that_no_body_has_is_told_of);
    tcase_add_test(cases, a_small_part_may_have_any_inertia);
    tcase_add_test(cases, drive_trains_may_have_any_inertia);
    tcase_add_test(cases, unknown_elements_are_told_of);
    return run_suite("tools", cases);
}
