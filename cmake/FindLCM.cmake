# Debian's liblcm-dev has no CMake package.
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
find_program(LCM_GEN lcm-gen)
# pkg-config itself would ask for glib's.
get_filename_component(LCM_LIBRARY_DIR "${LCM_LIBRARY}" DIRECTORY)
if(EXISTS ${LCM_LIBRARY_DIR}/pkgconfig/lcm.pc)
  file(STRINGS ${LCM_LIBRARY_DIR}/pkgconfig/lcm.pc LCM_VERSION REGEX "^Version: ")
  string(REPLACE "Version: " "" LCM_VERSION "${LCM_VERSION}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR LCM_GEN)
if(LCM_FOUND AND NOT TARGET LCM::lcm)
  add_library(LCM::lcm UNKNOWN IMPORTED)
  set_target_properties(LCM::lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
  add_library(LCM::coretypes INTERFACE IMPORTED)
  set_target_properties(LCM::coretypes PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
endif()
