// LIMPHOME_POSE: what viewers see of a machine, more often than it decides and more exactly than it senses.
#pragma once

#include "plant/link.h"
#include "plant/machine.h"

namespace limphome {

class Poses {
   public:
    // Both must outlive it.
    Poses(const Machine &machine, Link &link) : machine_(machine), link_(link) {}

    // Puts the pose at `now` [s, monotonic] on the bus if one is due: so seldom that it costs next to nothing.
    void show(double now, int32_t episode);
    // When the next one is [s, monotonic].
    double due() const { return due_; }

   private:
    const Machine &machine_;
    Link &link_;
    double due_ = 0;
};

}  // namespace limphome
