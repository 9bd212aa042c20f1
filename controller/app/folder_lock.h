/* Who works in a run folder. Its file `lock` has a byte for each role; whoever has one holds a lock of fcntl on it
 * until it ends, however it ends. The scripts hold the first byte, the controller the second. */
#ifndef LIMPHOME_APP_FOLDER_LOCK_H
#define LIMPHOME_APP_FOLDER_LOCK_H

#include <stdbool.h>

#include "fail.h"

/* Takes the controller's part of `folder`; `lock` is the descriptor to close in the end. False, naming the process that
 * has it, if another controller works there. */
bool folder_lock_take(int *lock, const char *folder, char error[ERROR_LENGTH]);

#endif
