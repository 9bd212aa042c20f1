/* What of the robot may touch: belts drawn as shapes are left out, and the robot stands on its crawlers. */
#include "edited.h"

static struct edited e; /* large for a stack frame */

#define SHAPE(pose, geometry) \
    "<collision name='s'><origin " pose "/><geometry>" geometry "</geometry></collision></link>"

/* A shape more on a link of the crawler. */
static void read_with(const char *link, const char *shape) {
    edited_begin(&e);
    char begin[64];
    snprintf(begin, sizeof begin, "<link name=\"%s\">", link);
    char *at = strstr(e.text, begin);
    ck_assert_ptr_nonnull(at);
    char *end = strstr(at, "</link>");
    static char rest[EDITED_LENGTH];
    snprintf(rest, sizeof rest, "%s", end + strlen("</link>"));
    snprintf(end, sizeof e.text - (size_t)(end - e.text), "%s%s", shape, rest);
    edited_read(&e);
}

static const struct {
    const char *link, *shape, *notice;
} belts[] = {
    {"left_sprocket", SHAPE("xyz='0.62 0 0'", "<box size='1.6 0.30 0.36'/>"),
     "<collision name=\"s\">: lies within the left crawler"},
    {"right_sprocket", SHAPE("rpy='1.5708 0 0'", "<cylinder radius='0.18' length='0.3'/>"),
     "lies within the right crawler"},
    {"base", SHAPE("xyz='0.3 0.475 0.10'", "<sphere radius='0.1'/>"), "lies within the left crawler"},
    {"base", SHAPE("xyz='0.3 -0.475 0.18' rpy='1.5708 0 0'", "<cylinder radius='0.18' length='0.2'/>"),
     "lies within the right crawler"},
};

START_TEST(shapes_that_are_the_belt_are_left_out) {
    read_with(belts[_i].link, belts[_i].shape);
    edited_expect_notice(&e, belts[_i].notice);
    ck_assert_int_eq(e.robot.num_shapes, 6); /* tip, chassis, cabin, boom, elbow, arm */
    edited_end(&e);
}
END_TEST

static const struct {
    const char *link, *shape, *words;
} refusals[] = {
    {"left_sprocket", SHAPE("xyz='0 0 0'", "<box size='1.6 0.30 0.36'/>"),
     "<link name=\"left_sprocket\"> <collision name=\"s\">: turns with the sprocket of a crawler and reaches beyond"},
    {"left_sprocket", SHAPE("xyz='0 0 0'", "<cylinder radius='0.1' length='0.9'/>"), "turns with the sprocket"},
    {"left_sprocket", SHAPE("xyz='0.9 0 0'", "<sphere radius='0.2'/>"), "turns with the sprocket"},
    {"left_sprocket", SHAPE("rpy='1.570796327 0 0'", "<cylinder radius='0.25' length='0.1'/>"),
     "reaches 0.07 m below the ground on which the crawlers stand: the robot would stand on it"},
    {"base", SHAPE("xyz='0 0 0.1'", "<box size='1.2 0.5 0.3'/>"),
     "<collision name=\"s\">: reaches 0.05 m below the ground"},
    {"base", SHAPE("xyz='0 0 0.1' rpy='0 0.5 0'", "<box size='1 0.5 0.01'/>"), "reaches 0.144 m below the ground"},
    {"base", SHAPE("xyz='0 0 0.4' rpy='0 0.5 0'", "<cylinder radius='0.2' length='1'/>"),
     "reaches 0.135 m below the ground"},
    {"base", SHAPE("xyz='0 0.475 0.18'", "<box size='1.6 0.36 0.36'/>"),
     "reaches down to 0 m above the ground on which"},
    {"arm", SHAPE("xyz='0.8 0 0'", "<sphere radius='1'/>"),
     "below the ground on which the crawlers stand (in the initial pose, home)"},
};

START_TEST(robots_that_would_not_stand_on_their_crawlers_are_refused) {
    read_with(refusals[_i].link, refusals[_i].shape);
    edited_expect_fault(&e, refusals[_i].words);
    edited_end(&e);
}
END_TEST

/* What is round about the sprocket may turn with it. */
START_TEST(hubs_are_kept) {
    read_with("left_sprocket", SHAPE("rpy='1.570796327 0 0'", "<cylinder radius='0.1' length='0.5'/>"));
    edited_expect_good(&e);
    ck_assert_int_eq(e.robot.num_shapes, 7);
    ck_assert_int_eq(e.robot.shapes[2].body, 1);
    ck_assert_int_eq(e.robot.shapes[2].kind, ROBOT_CYLINDER);
    ck_assert_double_eq(e.robot.shapes[2].half_size[2], 0.25);
    edited_end(&e);
}
END_TEST

START_TEST(a_tip_in_the_ground_is_refused) {
    edited_begin(&e);
    edited_replace(&e, "home=\"0.6\"", "home=\"-0.6\"");
    edited_read(&e);
    edited_expect_fault(&e, "<tip link=\"arm\">: reaches");
    edited_end(&e);
}
END_TEST

START_TEST(a_support_in_the_ground_is_refused) {
    edited_begin(&e);
    edited_replace(&e, "<support link=\"base\" xyz=\"0.62 0.625 0\"/>",
                   "<support link=\"base\" xyz=\"0.62 0.625 -0.1\"/>");
    edited_read(&e);
    edited_expect_fault(&e, "<support xyz=\"0.62 0.625 -0.1\">: lies 0.1 m below the ground");
    edited_end(&e);
}
END_TEST

/* The smallest are left out where there are too many. */
START_TEST(there_is_room_for_the_largest_shapes) {
    static char shapes[20000];
    size_t length = 0;
    for (int i = 0; i < 100; i++) {
        length +=
            (size_t)snprintf(shapes + length, sizeof shapes - length,
                             "<collision><origin xyz='0 0 0.4'/><geometry><sphere radius='%g'/></geometry></collision>",
                             0.01 + 1e-3 * i);
    }
    snprintf(shapes + length, sizeof shapes - length, "</link>");
    read_with("base", shapes);
    edited_expect_notice(&e, " shapes that may touch; the ");
    edited_expect_notice(&e, " smallest, of at most 0.");
    ck_assert_int_eq(e.robot.num_shapes, ROBOT_MAX_SHAPES);
    ck_assert_str_eq(e.robot.shapes[0].name, "arm"); /* the tip */
    double least = 1, largest = 0;
    int kept = 0;
    for (int i = 1; i < e.robot.num_shapes; i++) {
        if (strcmp(e.robot.shapes[i].name, "base") == 0 && e.robot.shapes[i].kind == ROBOT_SPHERE) {
            least = e.robot.shapes[i].half_size[0] < least ? e.robot.shapes[i].half_size[0] : least;
            largest = e.robot.shapes[i].half_size[0] > largest ? e.robot.shapes[i].half_size[0] : largest;
            kept++;
        }
    }
    ck_assert_int_lt(kept, 64);
    ck_assert_double_eq_tol(largest, 0.109, 1e-9);
    ck_assert_double_eq_tol(least, 0.109 - 1e-3 * (kept - 1), 1e-9); /* those between, all */
    edited_end(&e);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("touch");
    tcase_add_loop_test(cases, shapes_that_are_the_belt_are_left_out, 0, (int)(sizeof belts / sizeof belts[0]));
    tcase_add_loop_test(cases, robots_that_would_not_stand_on_their_crawlers_are_refused, 0,
                        (int)(sizeof refusals / sizeof refusals[0]));
    tcase_add_test(cases, hubs_are_kept);
    tcase_add_test(cases, a_tip_in_the_ground_is_refused);
    tcase_add_test(cases, a_support_in_the_ground_is_refused);
    tcase_add_test(cases, there_is_room_for_the_largest_shapes);
    return run_suite("touch", cases);
}
