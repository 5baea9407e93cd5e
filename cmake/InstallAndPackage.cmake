# `cmake --install` and `cpack`: programs and what they read at run time; what one needs to write a process of one's own.
include(CMakePackageConfigHelpers)
# What is installed is what `programs` builds; tests need not be there.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/fastball)
install(EXPORT fastball NAMESPACE fastball:: FILE fastballTargets.cmake DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/fastballConfig.cmake.in ${CMAKE_BINARY_DIR}/fastballConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/fastballConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/fastballConfig.cmake ${CMAKE_BINARY_DIR}/fastballConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindLCM.cmake ${CMAKE_CURRENT_LIST_DIR}/FindSodium.cmake
  DESTINATION ${package_dir} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)

# The manual page and the shell's completion come from the program's own --help.
set(manual ${CMAKE_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
add_custom_command(OUTPUT ${manual}/fastball.1 ${manual}/fastball.bash
  COMMAND fastball manual --man ${manual}/fastball.1 --completion ${manual}/fastball.bash DEPENDS fastball VERBATIM)
add_custom_target(manual DEPENDS ${manual}/fastball.1 ${manual}/fastball.bash)
add_dependencies(programs manual)
install(FILES ${manual}/fastball.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
install(FILES ${manual}/fastball.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME fastball
  COMPONENT programs)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The authors of fastball <fastball@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME fastball)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS gnuplot-nox)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS openssh-client)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfastball-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "liblcm-dev, libeigen3-dev, libyaml-cpp-dev, libfmt-dev, libspdlog-dev, libsodium-dev, \
libcli11-dev, libboost-dev, libboost-filesystem-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, libraries and messages for processes of one's own in the fastball experiment.")
include(CPack)
