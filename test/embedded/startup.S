/* Vector table and reset. In assembly, as a compiler may save FPU registers on entry to any C function, and that faults
 * before the FPU is on. */
    .syntax unified
    .thumb

    .section .vectors, "a"
    .word stack_top
    .word reset
    .rept 14
    .word fault
    .endr

    .text
    .thumb_func
    .global reset
    .type reset, %function
reset:
    ldr r0, =0xE000ED88             /* CPACR: full access to coprocessors 10 and 11, the FPU */
    ldr r1, [r0]
    orr r1, r1, #(0xF << 20)
    str r1, [r0]
    dsb
    isb
    bl start

    .thumb_func
    .type fault, %function
fault:
    bl stopped_by_fault
