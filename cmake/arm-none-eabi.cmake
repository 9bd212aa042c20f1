# Bare-metal Arm with the distribution's gcc-arm-none-eabi. cortex-m4f.cmake and cortex-m7.cmake are the toolchain files:
# they set the instruction set and the board that QEMU emulates, and include this.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # nothing links without a linker script

set(CMAKE_C_FLAGS_INIT "${limphome_instruction_set} -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${limphome_instruction_set}")
set(CMAKE_ASM_FLAGS_INIT "${limphome_instruction_set}")
# The costs that gcc knows for M4 and M7 rule out their multiply-accumulate, which rounds twice like two instructions, at
# -O2; those of Cortex-A7 do not. It saves an instruction in eight.
set(CMAKE_C_FLAGS_RELEASE "-O2 -mtune=cortex-a7" CACHE STRING "")
set(CMAKE_C_FLAGS_MINSIZEREL "-Os -mtune=cortex-a7" CACHE STRING "")

# Virtual time is instructions: one of them takes 1 ns (see test/embedded/count.c).
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-system-arm -machine ${limphome_board} -display none -monitor none -serial none
    -icount shift=0,sleep=off -semihosting-config enable=on,target=native -kernel)
