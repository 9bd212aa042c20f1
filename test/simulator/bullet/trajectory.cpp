// Prints a trajectory.
#include "bullet/trajectory.h"

#include <cstdio>

#include "laboratory.h"

int main() {
    using namespace limphome;
    World world(laboratory::paper_robot(), laboratory::left_locked());
    std::fputs(laboratory::trajectory(world).c_str(), stdout);
}
