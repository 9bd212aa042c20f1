# A Debian package of all that is installed: cpack -G DEB --config build/CPackConfig.cmake -B build/packages
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/limphome RENAME copyright COMPONENT programs)

set(CPACK_PACKAGE_NAME limphome)
set(CPACK_PACKAGE_CONTACT "The limphome authors <limphome@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL limphome programs messages plant)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # what the programs are linked with
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "liblcm-dev, pkg-config") # for programs that are built on the library or the plant
include(CPack)
