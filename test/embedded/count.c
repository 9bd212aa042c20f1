/* Counts instructions and stack of decisions on the emulated board, and fails beyond limits.
 *
 * Under `qemu -icount shift=0` an instruction takes 1 ns of virtual time, and SysTick counts the board's clock in
 * virtual time. That this holds is checked with a loop of known length. On a real board the same program counts clock
 * cycles, and the check fails. From the build come Q_LEARNING_LIMIT and PLANNER_LIMIT, instructions of one decision,
 * and Q_LEARNING_RECORDED and PLANNER_RECORDED, what test/counts.txt says of their mean, or 0.
 */
#include <stdint.h>

#include "platform.h"
#include "recording.h"

enum {
    MOST_DECISIONS = 2000,      /* counted, the first of the recording */
    INSTRUCTIONS_PER_TICK = 40, /* 25 MHz */
    STACK_LIMIT = 8192,         /* [bytes] */
};

static volatile uint32_t *const systick_control = (volatile uint32_t *)0xE000E010;
static volatile uint32_t *const systick_reload = (volatile uint32_t *)0xE000E014;
static volatile uint32_t *const systick_value = (volatile uint32_t *)0xE000E018;

enum { TICK_MASK = 0xFFFFFF };

static void start_ticks(void) {
    enum { ENABLE = 1, PROCESSOR_CLOCK = 4 };
    *systick_reload = TICK_MASK;
    *systick_value = 0;
    *systick_control = ENABLE | PROCESSOR_CLOCK;
}

/* Since `begin`, a value of SysTick, which counts down. */
static uint32_t instructions_since(uint32_t begin) {
    return ((begin - *systick_value) & TICK_MASK) * INSTRUCTIONS_PER_TICK;
}

/* Runs a loop of two instructions `rounds` times. */
static uint32_t count_loop(uint32_t rounds) {
    const uint32_t begin = *systick_value;
    __asm__ volatile("0: subs %0, #1\n bne 0b" : "+l"(rounds) : : "cc");
    return instructions_since(begin);
}

static void say_number(const char *name, uint32_t number) {
    char digits[11];
    char *digit = digits + sizeof digits - 1;
    *digit = '\0';
    do {
        *--digit = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    platform_say(name);
    platform_say(digit);
    platform_say("\n");
}

enum { UNUSED = 0x5A };

/* Fills what lies below the caller's stack frame. */
static __attribute__((noinline)) void paint_stack(void) {
    char *end = (char *)__builtin_frame_address(0) - 64;
    for (volatile char *byte = end - 4 * STACK_LIMIT; byte < end; byte++) {
        *byte = UNUSED;
    }
}

/* Bytes below `frame` that no longer are as painted. */
static uint32_t used_stack(const char *frame) {
    const char *lowest = frame - 3 * STACK_LIMIT;
    while (*(const volatile char *)lowest == UNUSED) {
        lowest++;
    }
    return (uint32_t)(frame - lowest);
}

typedef struct tally {
    uint32_t least, most, number;
    uint64_t sum;
} tally;

static void count(tally *t, uint32_t instructions) {
    t->least = instructions < t->least ? instructions : t->least;
    t->most = instructions > t->most ? instructions : t->most;
    t->sum += instructions;
    t->number++;
}

static lh_controller controller;

static bool count_decisions(tally *t) {
    int32_t decisions;
    const int file = recording_open(&controller, &decisions);
    for (int32_t i = 0; file >= 0 && i < decisions && i < MOST_DECISIONS; i++) {
        static lh_state state;
        static lh_decision decision;
        if (!recording_next(file, &state)) {
            return false;
        }
        const uint32_t begin = *systick_value;
        lh_controller_step(&controller, &state, &decision);
        count(t, instructions_since(begin));
    }
    return t->number > 0;
}

/* Whether it is beyond what was recorded, and the tolerance of scripts/counts. */
static bool is_more(uint32_t mean, uint32_t recorded) {
    enum { PERCENT = 103 };
    const bool more = recorded > 0 && (uint64_t)mean * 100 > (uint64_t)recorded * PERCENT;
    if (more) {
        say_number("more at the mean than test/counts.txt has, if right take it down by scripts/counts --record: ",
                   recorded);
    }
    return more;
}

int main(void) {
    enum { ROUNDS = 1000000 };
    start_ticks();
    const uint32_t loop = count_loop(ROUNDS);
    if (loop < 2 * ROUNDS - 100 || loop > 2 * ROUNDS + 100) {
        say_number("no count of instructions: 2000000 are counted as ", loop);
        return 1;
    }
    tally t = {.least = UINT32_MAX};
    paint_stack();
    if (!count_decisions(&t)) {
        return 1;
    }
    const uint32_t stack = used_stack(__builtin_frame_address(0));
    const uint32_t mean = (uint32_t)(t.sum / t.number);
    const bool is_planner = controller.learner.kind == LH_PLANNER;
    platform_say(is_planner ? "planner\n" : "q_learning\n");
    say_number("instructions per decision, least: ", t.least);
    say_number("instructions per decision, mean:  ", mean);
    say_number("instructions per decision, most:  ", t.most);
    say_number("stack of a decision [bytes]:      ", stack);
    say_number("lh_controller [bytes]:            ", sizeof(lh_controller));
    const bool beyond = t.most > (is_planner ? PLANNER_LIMIT : Q_LEARNING_LIMIT) || stack > STACK_LIMIT;
    return beyond || is_more(mean, is_planner ? PLANNER_RECORDED : Q_LEARNING_RECORDED) ? 1 : 0;
}
