/* What must hold between two settings. */
#include <math.h>

#include "settings_table.h"

static bool is_at_least(double value, double other) {
    return value >= other;
}

static bool is_within(double value, double other) {
    return fabs(value) <= other;
}

static bool is_whole_multiple(double value, double other) {
    const double times = value / other;
    return fabs(times - round(times)) <= 1e-6 * times;
}

/* One actuator fails once; none may fail twice. */
static bool is_another_actuator(double value, double other) {
    return value != other || (int)value == SETTINGS_FAILED_NONE;
}

/* Only a crawler has a belt that can slip. */
static bool is_mode_of(double mode, double actuator) {
    return (int)mode != SETTINGS_SLIPPING || (int)actuator < SETTINGS_FAILED_JOINT;
}

/* Refused with "[section] key = value: must be [section] other = value". The enumerators of a choice count as numbers.
 */
static const struct relation {
    int key, other; /* in settings_keys */
    bool (*holds)(double value, double other);
    const char *must_be;
} relations[] = {
    {KEY_rbf_initial_width, KEY_rbf_width_floor, is_at_least, "must be at least"},
    {KEY_rbf_initial_weight, KEY_rbf_weight_limit, is_within, "must be in magnitude at most"},
    {KEY_safety_crawler_speed, KEY_action_crawler_speed, is_at_least, "must be at least"},
    {KEY_safety_joint_speed, KEY_action_joint_speed, is_at_least, "must be at least"},
    {KEY_episode_decision_period_s, KEY_simulator_time_step_s, is_whole_multiple, "must be a whole number of"},
    {KEY_sensors_attitude_delay_s, KEY_simulator_time_step_s, is_whole_multiple, "must be a whole number of"},
    {KEY_sensors_position_delay_s, KEY_simulator_time_step_s, is_whole_multiple, "must be a whole number of"},
    {KEY_sensors_joint_delay_s, KEY_simulator_time_step_s, is_whole_multiple, "must be a whole number of"},
    {KEY_sensors_torque_delay_s, KEY_simulator_time_step_s, is_whole_multiple, "must be a whole number of"},
    {KEY_second_failure_actuator, KEY_failure_actuator, is_another_actuator, "must be another than"},
    {KEY_failure_mode, KEY_failure_actuator, is_mode_of, "is for crawlers only, not for"},
    {KEY_second_failure_mode, KEY_second_failure_actuator, is_mode_of, "is for crawlers only, not for"},
};

static bool check_range(const settings_key *key, const settings *s, char *error) {
    if (settings_key_in_range(key, s)) {
        return true;
    }
    char value[SETTINGS_VALUE_LENGTH];
    char allowed[SETTINGS_RANGE_LENGTH];
    settings_key_value(key, s, value);
    settings_key_range(key, allowed);
    return fail_with(error, "[%s] %s = %s: not allowed; %s is %s", key->section, key->name, value, key->name, allowed);
}

static bool check_relation(const struct relation *relation, const settings *s, char *error) {
    const settings_key *key = &settings_keys[relation->key];
    const settings_key *other = &settings_keys[relation->other];
    if (relation->holds(settings_key_number(key, s), settings_key_number(other, s))) {
        return true;
    }
    char value[SETTINGS_VALUE_LENGTH];
    char other_value[SETTINGS_VALUE_LENGTH];
    settings_key_value(key, s, value);
    settings_key_value(other, s, other_value);
    return fail_with(error, "[%s] %s = %s: %s [%s] %s = %s", key->section, key->name, value, relation->must_be,
                     other->section, other->name, other_value);
}

/* The monitor stills what changes its speed faster than its limit: a limit too low for the period stills all for ever.
 */
static bool check_acceleration(const settings *s, const char *kind, double limit, double speed, char *error) {
    const double period = s->episode.decision_period_s;
    const bool watched = s->safety.monitor == SETTINGS_MONITOR_ON || s->simulator.pace == SETTINGS_REAL_TIME;
    return !watched || limit * period >= speed ||
           fail_with(error,
                     "[safety] %s_acceleration = %g: nothing would ever move: must be at least %g, to come to [action] "
                     "%s_speed = %g in [episode] decision_period_s = %g",
                     kind, limit, speed / period, kind, speed, period);
}

bool settings_check(const settings *s, char error[ERROR_LENGTH]) {
    bool good = true;
    for (size_t i = 0; i < SETTINGS_KEY_COUNT && good; i++) {
        good = check_range(&settings_keys[i], s, error);
    }
    for (size_t i = 0; i < sizeof relations / sizeof relations[0] && good; i++) {
        good = check_relation(&relations[i], s, error);
    }
    return good && check_acceleration(s, "crawler", s->safety.crawler_acceleration, s->action.crawler_speed, error) &&
           check_acceleration(s, "joint", s->safety.joint_acceleration, s->action.joint_speed, error);
}
