# On the host: the recording, what the host makes of it, and one test for each board.
set(results ${CMAKE_CURRENT_BINARY_DIR})
set(sources ${CMAKE_CURRENT_SOURCE_DIR})

add_executable(record record.c)
target_link_libraries(record PRIVATE limphome_app limphome_warnings)
add_executable(replay replay.c recording.c host.c)
target_link_libraries(replay PRIVATE limphome limphome_warnings)
add_executable(elementary_bits elementary.c host.c)
target_link_libraries(elementary_bits PRIVATE limphome limphome_warnings)
set_target_properties(record replay elementary_bits PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${results})

add_test(NAME embedded.host COMMAND ${sources}/host.sh ${PROJECT_BINARY_DIR})
set_tests_properties(embedded.host PROPERTIES LABELS embedded FIXTURES_SETUP embedded.host TIMEOUT 600)

# one for speed, one for size; board.sh takes any pair
foreach(build cortex-m4f.Release cortex-m7.MinSizeRel)
  string(REPLACE "." ";" processor_and_type ${build})
  add_test(NAME embedded.${build} COMMAND ${sources}/board.sh ${processor_and_type} ${results}/${build} ${results})
  set_tests_properties(embedded.${build} PROPERTIES LABELS embedded FIXTURES_REQUIRED embedded.host TIMEOUT 600
                                                    SKIP_RETURN_CODE 77)
endforeach()
