// No memory is asked for once a world has been built: every call of malloc and its kin in this program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstddef>

#include "laboratory.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

#ifdef __has_feature
#define SANITIZED __has_feature(address_sanitizer)
#else
#define SANITIZED 0
#endif
#if SANITIZED || defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
#define CANNOT_COUNT "malloc belongs to somebody else here"
#else
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier): glibc's names
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *old, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier)

void *malloc(std::size_t size) {
    allocations++;
    return __libc_malloc(size);
}
void *calloc(std::size_t count, std::size_t size) {
    allocations++;
    return __libc_calloc(count, size);
}
void *realloc(void *old, std::size_t size) {
    allocations++;
    return __libc_realloc(old, size);
}
void *memalign(std::size_t alignment, std::size_t size) {
    allocations++;
    return __libc_memalign(alignment, size);
}
void *aligned_alloc(std::size_t alignment, std::size_t size) {
    return memalign(alignment, size);
}
int posix_memalign(void **result, std::size_t alignment, std::size_t size) {
    *result = memalign(alignment, size);
    return *result == nullptr ? ENOMEM : 0;
}
}
#endif

namespace limphome {
namespace {

using namespace laboratory;

class Allocation : public testing::Test {
   protected:
    void SetUp() override {
#ifdef CANNOT_COUNT
        GTEST_SKIP() << CANNOT_COUNT;
#endif
    }
};

TEST_F(Allocation, IsCounted) {
    const long before = allocations;
    const auto world = std::make_unique<World>(paper_robot(), left_locked());
    EXPECT_GT(allocations, before + 100);
}

long needed(World &world, const Rates &rates, double seconds) {
    const long before = allocations;
    run(world, rates, seconds);
    return allocations - before;
}

// The arm comes down, lifts the side, drags and lets go again, so that contacts come and go.
TEST_F(Allocation, StepsNeedNone) {
    World world(paper_robot(), left_locked());
    EXPECT_EQ(needed(world, {0, 0, 0.3}, 5), 0);
    EXPECT_EQ(needed(world, {0, 0, 0, -0.3}, 4), 0);
    ASSERT_GT(roll(world), 0.1);
    EXPECT_EQ(needed(world, {0, 0.3, -0.3}, 4), 0);
    EXPECT_EQ(needed(world, {0, -0.3, 0, 0.3}, 4), 0);
    ASSERT_NEAR(roll(world), 0, 0.01);
}

}  // namespace
}  // namespace limphome
