# libsodium: keyed hashes of commands, key files.
find_package(PkgConfig REQUIRED)
pkg_check_modules(SODIUM REQUIRED IMPORTED_TARGET libsodium)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Sodium REQUIRED_VARS SODIUM_LINK_LIBRARIES)
if(NOT TARGET Sodium::sodium)
  add_library(Sodium::sodium INTERFACE IMPORTED)
  target_link_libraries(Sodium::sodium INTERFACE PkgConfig::SODIUM)
endif()
