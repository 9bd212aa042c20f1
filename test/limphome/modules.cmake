# The Check tests of the library, room/topic, for the host and for the boards. Those of elementary are not among them: they
# are billions of double-precision operations, without an FPU for them on the boards; comparing bits says more there.
set(limphome_test_modules
  base/error base/random base/vector body/kinematics body/quasi_static body/rest body/robot body/stability
  body/stance
  task/action task/episode task/observation task/path task/reward task/task
  learning/boltzmann learning/learner learning/motion_model learning/network learning/planned learning/planner
  learning/planning learning/posture_values learning/q_learning
  safety/collision safety/forecast safety/interlock safety/monitor safety/plausibility safety/solid safety/stuck
  controller drive limits runs)

# Adds the program test_TOPIC of a module, whose tests lie in `folder`, with further sources; names the topic in `result`.
function(limphome_test module folder result)
  get_filename_component(topic ${module} NAME)
  get_filename_component(room ${module} DIRECTORY)
  cmake_path(SET source NORMALIZE ${folder}/${room}/test_${topic}.c)
  add_executable(test_${topic} ${source} ${ARGN})
  # the references are in double precision, so that results are promoted on purpose
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -Wno-double-promotion)
  set(${result} ${topic} PARENT_SCOPE)
endfunction()
