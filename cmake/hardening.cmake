# What makes a fault in memory end a program instead of handing it over: test/hardening looks whether the programs have it.
# For what runs on an operating system; each option where the compiler has it.
include(CheckCompilerFlag)
set(hardening
    -fPIC                         # code anywhere in memory: in programs, with -pie below, and in what they load
    -fvisibility=hidden           # where no function is replaced by another of the same name
    -fstack-protector-strong      # a changed return address is noticed
    -fstack-clash-protection      # the stack does not jump over its guard page
    -fcf-protection=full          # x86: indirect calls reach beginnings of functions alone
    -mbranch-protection=standard) # arm64: the same
foreach(option ${hardening})
  string(MAKE_C_IDENTIFIER "has${option}" has)
  check_compiler_flag(C ${option} ${has})
  if(${has})
    add_compile_options(${option})
  endif()
endforeach()
# Functions of the C library know the size of what they write to, where the compiler does, that is where it optimises; not
# beside sanitizers, which see more.
if(NOT "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS}" MATCHES "-fsanitize")
  foreach(option -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3)
    add_compile_options($<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:${option}>)
  endforeach()
endif()
# Addresses of functions are found at the start and read-only from then on; neither stack nor heap is code.
add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-pie> LINKER:-z,relro LINKER:-z,now
                 LINKER:-z,noexecstack)
