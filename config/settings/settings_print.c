/* Settings and their table as text, and the hash over that text. */
#include "settings_table.h"

void settings_write(const settings *s, FILE *out) {
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        const settings_key *key = &settings_keys[i];
        if (settings_key_begins_section(key)) {
            fprintf(out, "%s[%s]\n", i == 0 ? "" : "\n", key->section);
        }
        char value[SETTINGS_VALUE_LENGTH];
        settings_key_value(key, s, value);
        fprintf(out, "%s = %s\n", key->name, value);
    }
}

void settings_describe(FILE *out) {
    const settings standard = settings_default();
    fprintf(
        out,
        "# Configuration\n\nThe keys of an experiment's INI file, as both programs read it; "
        "`limphome-controller --help-settings` prints this page.\nA key that is not set has its default, which is the "
        "paper's where the paper gives one. Comments begin with `;`.\n\n");
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        const settings_key *key = &settings_keys[i];
        if (settings_key_begins_section(key)) {
            fprintf(out, "%s## [%s]\n\n| key | default | allowed | meaning |\n|---|---|---|---|\n", i == 0 ? "" : "\n",
                    key->section);
        }
        char value[SETTINGS_VALUE_LENGTH];
        char allowed[SETTINGS_RANGE_LENGTH];
        settings_key_value(key, &standard, value);
        settings_key_range(key, allowed);
        fprintf(out, "| `%s` | %s | %s | %s |\n", key->name, value, allowed, key->meaning);
    }
}

static uint64_t fnv1a(uint64_t hash, const char *text) {
    for (; *text != '\0'; text++) {
        hash = (hash ^ (unsigned char)*text) * 1099511628211u;
    }
    return hash;
}

uint64_t settings_hash(const settings *s) {
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        const settings_key *key = &settings_keys[i];
        if (key->decides) {
            char value[SETTINGS_VALUE_LENGTH];
            settings_key_value(key, s, value);
            hash = fnv1a(fnv1a(fnv1a(hash, key->section), key->name), value);
        }
    }
    return hash;
}
