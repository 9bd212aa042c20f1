# Sources of a target, with their folder, in the variable `result`: to compile them once more, with other flags or by another
# compiler.
function(sources_of target result)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  list(TRANSFORM sources PREPEND ${folder}/ REGEX "^[^/]")
  set(${result} ${sources} PARENT_SCOPE)
endfunction()
