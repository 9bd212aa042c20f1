/* What stands inside each other in the initial pose is told, with its depth. */
#include "edited.h"
#include "robot_overlap.h"

static struct edited e;

/* A ball on the chassis, 0.1 m beside the tip's, whose radius is 0.08. */
static void put_ball_beside_tip(double radius) {
    char ball[256];
    snprintf(ball, sizeof ball,
             "<collision><origin xyz=\"1.80516 0.1 0.79445\"/><geometry><sphere radius=\"%g\"/></geometry></collision>"
             "<collision name=\"chassis\">",
             radius);
    edited_begin(&e);
    edited_replace(&e, "<collision name=\"chassis\">", ball);
    edited_read(&e);
}

START_TEST(robots_of_config_are_apart) {
    static const char *const files[] = {CONFIG_DIR "/crawler.urdf", CONFIG_DIR "/crawler_half.urdf",
                                        CONFIG_DIR "/two_arm.urdf"};
    for (int i = 0; i < 3; i++) {
        robot_description robot;
        robot_overlap overlap;
        ck_assert(robot_file_load(files[i], NULL, &robot));
        ck_assert_int_eq(robot_overlaps_at_home(&robot, &overlap, 1), 0);
    }
}
END_TEST

START_TEST(depth_is_told) {
    put_ball_beside_tip(0.019);
    edited_expect_good(&e);
    edited_end(&e);
    put_ball_beside_tip(0.05);
    edited_expect_fault(&e,
                        "arm and base reach 0.03 m into each other in the initial pose; must not, or be excepted by "
                        "<no_contact link1=\"arm\" link2=\"base\"/>");
    ck_assert_int_eq(e.report.num_faults, 1);
    edited_end(&e);
}
END_TEST

/* Folded, turned aside and lowered the arm stands in the left crawler. */
static void fold_over_crawler(void) {
    edited_begin(&e);
    edited_replace(&e, "<arm joint=\"swing\" home=\"0\"/>", "<arm joint=\"swing\" home=\"0.6\"/>");
    edited_replace(&e, "<arm joint=\"boom\" home=\"0.6\"/>", "<arm joint=\"boom\" home=\"-0.1\"/>");
    edited_replace(&e, "<arm joint=\"arm\" home=\"-1.5\"/>", "<arm joint=\"arm\" home=\"-2.4\"/>");
}

START_TEST(belts_count) {
    fold_over_crawler();
    edited_read(&e);
    edited_expect_fault(&e, "arm and the left belt reach");
    edited_end(&e);
}
END_TEST

START_TEST(what_is_excepted_may_stand_inside) {
    fold_over_crawler();
    edited_replace(&e, "<crawler joint=\"left", "<no_contact link1=\"arm\" link2=\"base\"/><crawler joint=\"left");
    edited_read(&e);
    edited_expect_good(&e);
    edited_end(&e);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("overlap");
    tcase_add_test(cases, robots_of_config_are_apart);
    tcase_add_test(cases, depth_is_told);
    tcase_add_test(cases, belts_count);
    tcase_add_test(cases, what_is_excepted_may_stand_inside);
    return run_suite("overlap", cases);
}
