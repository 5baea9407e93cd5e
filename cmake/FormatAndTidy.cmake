# `format` rewrites our own files, `check-format` only looks, `tidy` runs clang-tidy over them; not in a release build, which
# compiles sources together, so that clang-tidy would not find them.
file(GLOB_RECURSE own_files
  ${PROJECT_SOURCE_DIR}/messaging/*.[ch]* ${PROJECT_SOURCE_DIR}/model/*.[ch]*
  ${PROJECT_SOURCE_DIR}/config/*.[ch]* ${PROJECT_SOURCE_DIR}/planner/*.[ch]*
  ${PROJECT_SOURCE_DIR}/controller/*.[ch]* ${PROJECT_SOURCE_DIR}/hand_server/*.[ch]*
  ${PROJECT_SOURCE_DIR}/sim_bullet/*.[ch]* ${PROJECT_SOURCE_DIR}/vision_tracker/*.[ch]*
  ${PROJECT_SOURCE_DIR}/camera/*.[ch]* ${PROJECT_SOURCE_DIR}/logger/*.[ch]* ${PROJECT_SOURCE_DIR}/launch/*.[ch]*
  ${PROJECT_SOURCE_DIR}/tests/*.[ch]* ${PROJECT_SOURCE_DIR}/bench/*.[ch]*)
list(FILTER own_files INCLUDE REGEX "\\.(cpp|h)$")
find_program(CLANG_FORMAT clang-format)
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14)
if(CLANG_FORMAT)
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${own_files} VERBATIM)
  add_custom_target(check-format COMMAND ${CLANG_FORMAT} --dry-run --Werror ${own_files} VERBATIM)
endif()
if(RUN_CLANG_TIDY AND NOT CMAKE_BUILD_TYPE STREQUAL Release)
  set(own_sources ${own_files})
  list(FILTER own_sources INCLUDE REGEX "\\.cpp$")
  add_custom_target(tidy COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR} ${own_sources} VERBATIM)
  add_dependencies(tidy lcmtypes_generate)
endif()
