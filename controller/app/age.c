#include "age.h"

static const double drift = 200e-6;   /* of one clock against the other: two bad quartz clocks */
static const double tolerance = 1e-3; /* the clocks are read a little apart [s] */

void age_begin(age_tracker *tracker, double asked, double sent, double now) {
    *tracker = (age_tracker){.least = now - sent, .floor = asked - sent, .updated = now};
}

age_verdict age_judge(age_tracker *tracker, double sent, double now, double limit) {
    const double drifted = drift * (now - tracker->updated);
    tracker->least += drifted;
    tracker->floor -= drifted;
    tracker->updated = now;
    const double difference = now - sent;
    if (difference < tracker->floor - tolerance) {
        return AGE_IMPOSSIBLE;
    }
    if (difference - tracker->least > limit) {
        return AGE_STALE;
    }
    if (difference < tracker->least) {
        tracker->least = difference;
    }
    return AGE_FRESH;
}
