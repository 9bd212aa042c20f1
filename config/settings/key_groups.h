/* Keys that come several times, told once: those of one failure and those of the errors of one kind of sensor. The
 * columns are those of keys.def, which uses the groups. */
#ifndef LIMPHOME_KEY_GROUPS_H
#define LIMPHOME_KEY_GROUPS_H

/* One actuator that fails; `actuator_standard` is the default of what fails. */
#define SETTINGS_FAILURE_KEYS(section, actuator_standard)                                                            \
    CHOICE(section, actuator, failed, actuator_standard, DECIDES,                                                    \
           "what fails; arm joints are numbered from root to tip")                                                   \
    CHOICE(section, mode, failure_mode, SETTINGS_LOCKED, DECIDES,                                                    \
           "how it fails; slipping: the drive works, but the belt has lost its friction")                            \
    REAL(section, weak_factor, 0, 1, 0.3, DECIDES, "torque limit left to a weak drive, as a share of the rated one") \
    REAL(section, slip_factor, 0, 1, 0.05, DECIDES, "friction left to a slipping crawler, as a share")               \
    REAL(section, at_s, 0, 1e6, 0, DECIDES, "time since the reset at which it fails [s]")                            \
    WHOLE(section, at_episode, 0, 1000000, 0, DECIDES,                                                               \
          "it fails from the first reset at or after this episode on; 0: from the start")

/* Errors of the sensors of one quantity, `high` at most; `of` says what they read, with its unit. All 0: exact.
 * SENSOR_REAL(quantity, name, ...) is REAL for the field sensors.quantity.name, whose key is quantity_name. */
#define SETTINGS_SENSOR_KEYS(quantity, high, of)                                                                  \
    SENSOR_REAL(quantity, noise, 0, high, 0, DECIDES, "standard deviation of the noise " of)                      \
    SENSOR_REAL(quantity, bias, 0, high, 0, DECIDES,                                                              \
                "largest constant error " of "; each value draws its own at each reset")                          \
    SENSOR_REAL(quantity, quantum, 0, high, 0, DECIDES, "readings are rounded to multiples of it " of "; 0: not") \
    SENSOR_REAL(quantity, delay_s, 0, 5, 0, DECIDES, "age of what is read [s]; a whole number of time steps")

#endif
