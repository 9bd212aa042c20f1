#include "model/random_stream.h"

#include <cmath>

namespace limphome {
namespace {

std::mt19937_64 make_engine(int64_t seed, Purpose purpose, int64_t episode) {
    std::seed_seq words{static_cast<int64_t>(purpose), seed, seed >> 32, episode, episode >> 32};
    return std::mt19937_64(words);
}

}  // namespace

RandomStream::RandomStream(int64_t seed, Purpose purpose, int64_t episode)
    : engine_(make_engine(seed, purpose, episode)) {}

double RandomStream::uniform(double low, double high) {
    constexpr double unit = 0x1p-53;
    return low + (high - low) * (static_cast<double>(bits() >> 11) * unit);
}

// Box and Muller's.
double RandomStream::normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(2 * M_PI * uniform(0, 1));
}

}  // namespace limphome
