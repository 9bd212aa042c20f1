#include "plant.h"

#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>

#include "bullet/world.h"
#include "model/robot_model.h"
#include "plant/link.h"
#include "plant/loop.h"

struct plant {
    plant(const robot_description &robot, const settings &s)
        : world(limphome::make_model(robot), s),
          link(PLANT_OWN_QUEUE, s, world.num_actuators()),
          loop(world, link, s) {}

    limphome::World world;
    limphome::Link link;
    limphome::Loop loop;
    volatile std::sig_atomic_t *stop = nullptr;
    bool failed = false;
};

namespace {

void require_lockstep(const settings &s) {
    if (s.simulator.pace != SETTINGS_LOCKSTEP) {
        throw std::runtime_error(
            "[simulator] pace = real_time: controller and plant follow the clock side by side, as two processes; "
            "limphome-pair needs pace = lockstep");
    }
}

// Called from C, which no exception may cross. Says what went wrong on stderr; whether nothing did.
template <typename Work>
bool guarded(Work work) {
    try {
        return work();
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return false;
    }
}

void go_on(void *user) {
    plant *p = static_cast<plant *>(user);
    p->failed = p->failed || !guarded([p] { return p->loop.pass(); });
    if (p->failed) {
        *p->stop = 1;
    }
}

}  // namespace

plant *plant_open(const robot_description *robot, const settings *s) {
    std::unique_ptr<plant> made;
    guarded([&] {
        require_lockstep(*s);
        made = std::make_unique<plant>(*robot, *s);
        return true;
    });
    return made.release();
}

void plant_begin(plant *p, udpm *controller, volatile sig_atomic_t *stop) {
    p->stop = stop;
    udpm_join(controller, p->link.bus().in_c(), go_on, p);
    p->loop.start(stop);
}

bool plant_close(plant *p) {
    const bool good = !p->failed;
    delete p;
    return good;
}
