# On a board, with start-up code, linker script and output of our own. QEMU runs each test.
enable_language(ASM)
set(LIMPHOME_HOST_RESULTS ${CMAKE_SOURCE_DIR}/build/test/embedded CACHE PATH "what the test embedded.host has left")

add_library(limphome_board INTERFACE)
target_sources(limphome_board INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/startup.S ${CMAKE_CURRENT_SOURCE_DIR}/board.c)
target_include_directories(limphome_board INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_options(limphome_board INTERFACE -nostartfiles -Wl,--gc-sections -T ${CMAKE_CURRENT_SOURCE_DIR}/mps2.ld)
target_link_libraries(limphome_board INTERFACE limphome)

# The Check tests of the library, by a stand-in for Check.
set(tests ${CMAKE_SOURCE_DIR}/test/limphome)
include(${tests}/modules.cmake)
foreach(module ${limphome_test_modules})
  limphome_test(${module} ${tests} name ${tests}/runner.c ${tests}/crawler.c check.c)
  target_include_directories(test_${name} PRIVATE ${tests})
  target_compile_definitions(test_${name} PRIVATE _DEFAULT_SOURCE) # M_PI
  target_link_libraries(test_${name} PRIVATE limphome_board limphome_warnings m)
  add_test(NAME ${name} COMMAND test_${name})
endforeach()

# Programs whose results must have the bytes of the host's.
add_executable(replay replay.c recording.c)
add_executable(elementary_bits elementary.c)
add_executable(count count.c recording.c)
target_compile_definitions(count PRIVATE INSTRUCTION_LIMIT=$<IF:$<CONFIG:Release>,100000,115000>) # for speed, for size
foreach(program replay elementary_bits count)
  target_link_libraries(${program} PRIVATE limphome_board limphome_warnings)
  add_test(NAME ${program} COMMAND ${program})
endforeach()

add_test(NAME recording COMMAND ${CMAKE_COMMAND} -E copy ${LIMPHOME_HOST_RESULTS}/recording.bin .)
set_tests_properties(recording PROPERTIES FIXTURES_SETUP recording)
set_tests_properties(replay PROPERTIES FIXTURES_REQUIRED recording FIXTURES_SETUP results)
set_tests_properties(elementary_bits PROPERTIES FIXTURES_SETUP results)
set_tests_properties(count PROPERTIES FIXTURES_REQUIRED recording)
foreach(result decisions learner elementary)
  add_test(NAME same_${result} COMMAND ${CMAKE_COMMAND} -E compare_files ${result}.bin
                                       ${LIMPHOME_HOST_RESULTS}/${result}.bin)
  set_tests_properties(same_${result} PROPERTIES FIXTURES_REQUIRED results)
endforeach()

add_test(NAME symbols COMMAND ${tests}/check_symbols.sh $<TARGET_FILE:limphome>)
add_test(NAME size COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/size.sh $<TARGET_FILE:limphome>)
