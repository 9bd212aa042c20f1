#include "rollback.h"

#include <string.h>

void rollback_keep(rollback *kept, const lh_controller *controller, int32_t episodes, const run_folder *folder) {
    memcpy(&kept->controller, controller, sizeof *controller);
    kept->place = run_folder_here(folder, episodes);
}

bool rollback_return(const rollback *kept, lh_controller *controller, run_folder *folder, char error[ERROR_LENGTH]) {
    memcpy(controller, &kept->controller, sizeof *controller);
    return run_folder_cut(folder, &kept->place, error);
}
