/* An INI file of any bytes is refused with a text, or gives settings that are written and read back the same. */
#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "settings.h"

static void expect_same_when_written(const settings *s) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    FUZZ_EXPECT(out != NULL);
    settings_write(s, out);
    fclose(out);
    settings again = settings_default();
    char error[ERROR_LENGTH] = "";
    FUZZ_EXPECT(settings_read(&again, fuzz_file((const uint8_t *)text, size), error));
    FUZZ_EXPECT(settings_hash(s) == settings_hash(&again));
    free(text);
}

/* The first line as the value of --set. */
static void set_first_line(const uint8_t *data, size_t size) {
    char assignment[256] = "";
    memcpy(assignment, data, size < sizeof assignment ? size : sizeof assignment - 1);
    assignment[strcspn(assignment, "\n")] = '\0';
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    FUZZ_EXPECT(settings_set(&s, assignment, error) || error[0] != '\0');
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    if (settings_read(&s, fuzz_file(data, size), error)) {
        settings_check(&s, error);
        expect_same_when_written(&s);
    } else {
        FUZZ_EXPECT(error[0] != '\0' && memchr(error, '\0', sizeof error) != NULL);
    }
    set_first_line(data, size);
    return 0;
}
