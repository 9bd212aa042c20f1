/* Settings: what an experiment's INI file says, read the same way by both processes.
 *
 * Every key has a type, a range and a default (the paper's, where the paper gives one); settings.c holds the
 * table. An unknown key, a key set twice, a bad number or a value out of range is refused with its place, the
 * value and what is allowed. `--help-settings` of either program prints the table.
 */
#ifndef LIMPHOME_SETTINGS_H
#define LIMPHOME_SETTINGS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum settings_gradient { SETTINGS_GRADIENT_PRINTED = 0, SETTINGS_GRADIENT_EXACT = 1 };
enum settings_turn { SETTINGS_TURN_CHANGE = 0, SETTINGS_TURN_ERROR = 1 };
/* From SETTINGS_FAILED_JOINT on: the arm joints from root to tip. */
enum settings_failed {
    SETTINGS_FAILED_LEFT = 0,
    SETTINGS_FAILED_RIGHT = 1,
    SETTINGS_FAILED_NONE = 2,
    SETTINGS_FAILED_JOINT = 3
};
enum settings_failure_mode { SETTINGS_LOCKED = 0, SETTINGS_FREE = 1, SETTINGS_WEAK = 2, SETTINGS_SLIPPING = 3 };
enum settings_pace { SETTINGS_LOCKSTEP = 0, SETTINGS_REAL_TIME = 1 };

/* One actuator that fails. */
typedef struct settings_failure {
    int64_t actuator;   /* enum settings_failed */
    int64_t mode;       /* enum settings_failure_mode */
    double weak_factor; /* torque limit of a weak drive over its rated one, 0 to 1 */
    double slip_factor; /* friction of a slipping crawler over that of a sound one, 0 to 1 */
    double at_s;        /* time since the reset, 0 to 1e6 s */
} settings_failure;

/* Errors of one kind of sensor, in its unit; all 0: exact. */
typedef struct settings_sensor {
    double noise;   /* standard deviation */
    double bias;    /* largest constant error; each value draws its own at each reset */
    double quantum; /* readings are rounded to multiples of it */
    double delay_s; /* age of what is read [s], 0 to 5 */
} settings_sensor;

typedef struct settings {
    struct {
        int64_t seed;         /* of every random number, 0 to 2^31 - 1 */
        int64_t episodes;     /* to train for, 1 to 1000000 */
        double learning_rate; /* alpha of (2), 0 to 1 */
        double discount_rate; /* gamma of (1), 0 to 1 */
    } learning;
    struct {
        int64_t units;         /* basis functions of (13), 1 to 64 */
        double rate_weight;    /* alpha_w of (19), 0 to 10 */
        double rate_width;     /* alpha_sigma of (20), 0 to 10 */
        double rate_centre;    /* alpha_mu of (21), 0 to 10 */
        double initial_weight; /* w_j, -100 to 100 */
        double initial_width;  /* sigma_j, 0.05 to 100 */
        double width_floor;    /* least sigma_j, 0.01 to 1 */
        double weight_limit;   /* largest |w_j|, 1 to 1e6 */
        int64_t gradient;      /* enum settings_gradient: (19)-(21) as printed, or the derivative of (15) */
    } rbf;
    struct {
        double temperature_floor; /* least T of (4), 1e-4 to 10 */
    } exploration;
    struct {
        double crawler_speed; /* of the forward and reverse levels, Table 1 [m/s], 0.01 to 2 */
        double joint_speed;   /* of the forward and reverse levels, Table 1 [rad/s], 0.01 to 2 */
    } action;
    struct {
        double forward;   /* eta of (8) [1/m], 0 to 1000 */
        double sideways;  /* lambda of (8) [1/m], 0 to 1000 */
        double turn;      /* tau of (8) [1/rad], 0 to 1000 */
        int64_t turn_of;  /* enum settings_turn: what phi of (8) is */
        double goal;      /* zeta of (9), 0 to 1000 */
        double stability; /* rho of (12), 0 to 1000 */
        double tumble;    /* added to the step in which the robot tumbles, -1000 to 0 */
    } reward;
    struct {
        double decision_period_s; /* 0.01 to 10 s; a whole number of time steps */
        double goal_distance_m;   /* b, 0.1 to 100 m */
        int64_t step_limit;       /* decisions before an episode is given up, 1 to 100000 */
        double tumble_tilt_rad;   /* angle between body z and world z that counts as tumbled, 0.1 to 3 rad */
        int64_t reset_every;      /* episodes between returns to the initial pose, where a checkpoint is taken */
    } episode;
    settings_failure failure;
    settings_failure second_failure;
    struct {
        double time_step_s;        /* 1e-4 to 0.02 s */
        int64_t solver_iterations; /* 1 to 1000 */
        int64_t pace;              /* enum settings_pace */
        double friction_crawler;   /* Coulomb coefficient, 0 to 2 */
        double friction_arm;       /* Coulomb coefficient, 0 to 2 */
    } simulator;
    struct {
        int64_t seed;              /* of rough ground and patches, 0 to 2^31 - 1 */
        double incline_along_rad;  /* uphill along +y [rad], -1 to 1 */
        double incline_across_rad; /* uphill along +x [rad], -1 to 1 */
        double rough_amplitude_m;  /* largest height over or under the mean [m], 0 to 1; 0: smooth */
        double rough_wavelength_m; /* of the shortest bumps [m], 0.4 to 100 */
        double step_height_m;      /* of every other strip across [m], 0 to 2; 0: none */
        double step_spacing_m;     /* length of a strip [m], 0.5 to 100 */
        double patch_share;        /* of the ground that is loose, 0 to 1; 0: none */
        double patch_size_m;       /* side of a patch [m], 0.1 to 100 */
        double patch_friction;     /* on loose ground over that elsewhere, 0 to 1 */
    } ground;
    struct {
        settings_sensor attitude; /* of roll, pitch and heading [rad] */
        settings_sensor position; /* [m] */
        settings_sensor joint;    /* angles of arm joints [rad] */
        settings_sensor torque;   /* of all drives [N m] */
    } sensors;
    struct {
        double friction; /* half-widths of what is drawn at each reset, as shares, 0 to 0.9 */
        double mass;     /* of each body */
        double torque;   /* limit of each drive */
    } randomisation;
    struct {
        double proportional; /* velocity error to acceleration [1/s], 0 to 1000 */
        double integral;     /* integrated velocity error to acceleration [1/s^2], 0 to 100000 */
        double derivative;   /* change of velocity error to acceleration [-], 0 to 1 */
    } drive;
    struct {
        double resend_s;          /* unanswered states and reset requests are sent again after this, 0.001 to 1 s */
        double command_timeout_s; /* real time: age at which a command is no longer obeyed, 0.01 to 10 s */
        double sender_timeout_s;  /* silence after which the plant obeys another sender, 0.1 to 60 s */
    } link;
} settings;

/* Length of an error text that always fits. */
#define SETTINGS_ERROR_LENGTH 512

/* The paper's experiment. */
settings settings_default(void);

/* Reads `path` over what `s` holds. 0 on success; else -1 and a text with file, line, key and range in `error`. */
int settings_read(settings *s, const char *path, char error[SETTINGS_ERROR_LENGTH]);

/* Applies one `section.key=value` from the command line. 0 on success, else -1 and a text in `error`. */
int settings_set(settings *s, const char *assignment, char error[SETTINGS_ERROR_LENGTH]);

/* Checks what spans several keys, once all are known: the decision period and the delays must be whole numbers of time
 * steps; the two failures must be of different actuators, and joints do not slip. 0 on success, else -1 and a text in
 * `error`. */
int settings_check(const settings *s, char error[SETTINGS_ERROR_LENGTH]);

/* Writes every key with its value as an INI file that settings_read accepts and that gives the same settings. */
void settings_write(const settings *s, FILE *out);

/* Writes the table of keys with ranges, defaults and meanings, as Markdown. */
void settings_describe(FILE *out);

/* FNV-1a hash of the keys that decide what is learned. Left out: learning.episodes (a resumed run may be longer),
 * simulator.pace and [link]. */
uint64_t settings_hash(const settings *s);

#ifdef __cplusplus
}
#endif
#endif
