// Random numbers of the simulation.
#pragma once

#include <cstdint>
#include <random>

namespace limphome {

// What a stream is for; streams for different purposes are independent of each other.
enum class Purpose {
    rough_ground = 1,
    patches = 2,
    randomisation = 3,
    sensor_bias = 4,
    sensor_noise = 5,
    shooting = 6,
    start = 7
};

// Depends on nothing but what it is made from, so that a resumed run draws what an unbroken one draws.
class RandomStream {
   public:
    RandomStream(int64_t seed, Purpose purpose, int64_t episode = 0);

    uint64_t bits() { return engine_(); }     // 64, each 0 or 1 alike
    double uniform(double low, double high);  // low <= result < high
    double normal();                          // mean 0, standard deviation 1

   private:
    std::mt19937_64 engine_;  // unlike the distributions of <random>, the same everywhere
};

}  // namespace limphome
