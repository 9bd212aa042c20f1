// A caller in C++.
#include <limphome/limphome.h>

#include <memory>

int main() {
    const auto controller = std::make_unique<lh_controller>();
    const lh_config config = lh_config_default();
    return lh_config_validate(&config) == LH_OK && lh_exp(0.0f) == 1.0f && sizeof *controller > 0 ? 0 : 1;
}
