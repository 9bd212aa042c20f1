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
# two are of many decisions, half a minute each: each on one board
if(CMAKE_BUILD_TYPE STREQUAL Release)
  list(FILTER limphome_test_modules EXCLUDE REGEX "^limits$")
else()
  list(FILTER limphome_test_modules EXCLUDE REGEX "/q_learning$")
endif()
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
# instructions of a decision: Q-learning's budget, of which what is made for size may take a tenth more; a planner's leave
# 95 % of 0.5 s at 216 MHz to others
target_compile_definitions(count PRIVATE Q_LEARNING_LIMIT=$<IF:$<CONFIG:Release>,100000,110000>
                                         PLANNER_LIMIT=5400000)
# and not more at the mean than scripts/counts recorded of this board, where it did
set(board_Release_cortex-m4 m4f)
set(board_MinSizeRel_cortex-m7 m7_small)
string(REGEX MATCH "cortex-m[0-9]" processor "${limphome_instruction_set}")
file(STRINGS ${CMAKE_SOURCE_DIR}/test/counts.txt counts REGEX "^decision_")
foreach(learner q_learning planner)
  set(recorded 0)
  foreach(line ${counts})
    if(line MATCHES "^decision_${learner}_${board_${CMAKE_BUILD_TYPE}_${processor}} ([0-9]+)$")
      set(recorded ${CMAKE_MATCH_1})
    endif()
  endforeach()
  string(TOUPPER ${learner} name)
  target_compile_definitions(count PRIVATE ${name}_RECORDED=${recorded})
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/test/counts.txt)
foreach(program replay elementary_bits count)
  target_link_libraries(${program} PRIVATE limphome_board limphome_warnings)
endforeach()

function(add_comparison name file fixture)
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E compare_files ${file} ${LIMPHOME_HOST_RESULTS}/${file})
  set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED ${fixture})
endfunction()

add_test(NAME elementary_bits COMMAND elementary_bits)
set_tests_properties(elementary_bits PROPERTIES FIXTURES_SETUP elementary)
add_comparison(same_elementary elementary.bin elementary)

# each recorded run in a folder of its own
foreach(learner q_learning planner)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${learner})
  add_test(NAME recording_${learner}
           COMMAND ${CMAKE_COMMAND} -E copy ${LIMPHOME_HOST_RESULTS}/${learner}/recording.bin ${learner})
  set_tests_properties(recording_${learner} PROPERTIES FIXTURES_SETUP recording_${learner})
  foreach(program replay count)
    add_test(NAME ${program}_${learner} COMMAND ${program}
             WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${learner})
    set_tests_properties(${program}_${learner} PROPERTIES FIXTURES_REQUIRED recording_${learner})
  endforeach()
  set_tests_properties(replay_${learner} PROPERTIES FIXTURES_SETUP replay_${learner})
  foreach(result decisions learner)
    add_comparison(same_${result}_${learner} ${learner}/${result}.bin replay_${learner})
  endforeach()
endforeach()

add_test(NAME symbols COMMAND ${tests}/check_symbols.sh $<TARGET_FILE:limphome>)
add_test(NAME size COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/size.sh $<TARGET_FILE:limphome>)
