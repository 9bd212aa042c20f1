# find_package(limphome): the library, limphome::limphome, which needs nothing else. find_package(limphome COMPONENTS
# plant): limphome::plant, for the drivers of real robots.
if(NOT limphome_FIND_COMPONENTS)
  set(limphome_FIND_COMPONENTS limphome)
endif()
if("plant" IN_LIST limphome_FIND_COMPONENTS)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(lcm REQUIRED IMPORTED_TARGET lcm)
  pkg_check_modules(inih REQUIRED IMPORTED_TARGET inih)
endif()
foreach(component IN LISTS limphome_FIND_COMPONENTS)
  include(${CMAKE_CURRENT_LIST_DIR}/limphome-${component}.cmake)
endforeach()
