#include "json.h"

#include <math.h>
#include <stdlib.h>

#include "suite.h"

START_TEST(commas_stand_between_and_nowhere_else) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    json j = {out, true};
    json_open(&j, NULL, '{');
    json_whole(&j, "a", 1);
    json_open(&j, "b", '[');
    json_open(&j, NULL, '{');
    json_close(&j, '}');
    json_open(&j, NULL, '[');
    json_close(&j, ']');
    json_bool(&j, NULL, true);
    json_close(&j, ']');
    json_numbers(&j, "c", (const double[]){0.5, -2}, 2);
    json_close(&j, '}');
    fclose(out);
    ck_assert_str_eq(text, "{\"a\": 1, \"b\": [{}, [], true], \"c\": [0.5, -2]}");
    free(text);
}
END_TEST

START_TEST(texts_are_escaped_and_what_is_no_number_is_null) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    json j = {out, true};
    json_open(&j, NULL, '[');
    json_text(&j, NULL, "a \"b\" \\ \n \x01 \xc3\xa4");
    json_number(&j, NULL, NAN);
    json_number(&j, NULL, -INFINITY);
    json_number(&j, NULL, 0.1);
    json_close(&j, ']');
    fclose(out);
    ck_assert_str_eq(text, "[\"a \\\"b\\\" \\\\ \\u000a \\u0001 \xc3\xa4\", null, null, 0.10000000000000001]");
    free(text);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("json");
    tcase_add_test(cases, commas_stand_between_and_nowhere_else);
    tcase_add_test(cases, texts_are_escaped_and_what_is_no_number_is_null);
    return run_suite("json", cases);
}
