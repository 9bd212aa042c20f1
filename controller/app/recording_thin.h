/* What keeps a recording from growing without end. */
#ifndef LIMPHOME_APP_RECORDING_THIN_H
#define LIMPHOME_APP_RECORDING_THIN_H

#include "recording.h"

/* Where the file has become longer than `limit` [bytes], drops all of the middle but the messages that tell of the end
 * of an episode. The first eighth of the limit stays, and the newest half: what figures and diagnosis look at. An event
 * keeps its number, so that a gap in the numbers tells of what was dropped. *thinned tells whether it did. False, with
 * the reason in `error`, if the file cannot be replaced. */
bool recording_thin(recording *r, int64_t limit, bool *thinned, char error[ERROR_LENGTH]);

#endif
