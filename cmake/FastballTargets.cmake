# How every folder declares its parts. Warnings are for our own code; libraries come in as SYSTEM.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
# The same result on every machine: no fused multiply-add that one CPU has and another has not.
add_compile_options(-ffp-contract=off)
# GCC collects its garbage from 128 MB on, which is a tenth of the time that Eigen's templates take. Ninja runs two more than cores.
cmake_host_system_information(RESULT memory_mb QUERY TOTAL_PHYSICAL_MEMORY)
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR memory_each_mb "${memory_mb} / (${cores} + 2)")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND memory_each_mb GREATER 2000)
  add_compile_options(--param=ggc-min-heapsize=1000000)
endif()
if(FASTBALL_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(FASTBALL_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

function(fastball_settings target)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/fastball>)
  # Instrumented code makes GCC see uninitialised values inside std::regex.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow
    $<$<BOOL:${FASTBALL_STRICT}>:-Werror>
    $<$<BOOL:${FASTBALL_SANITIZE}>:-Wno-maybe-uninitialized>)
  if(FASTBALL_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "clang-tidy;--quiet")
  endif()
endfunction()

# fastball_headers(name LIBRARIES ... HEADERS ...): headers that are read once for all targets that name it in
# fastball_precompiled(). The build type Debug does without, and so finds what a file forgets to include.
function(fastball_headers name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  fastball_settings(${name})
endfunction()
function(fastball_precompiled target headers)
  if(NOT CMAKE_BUILD_TYPE STREQUAL Debug AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()

# fastball_together(target sources...): a release build compiles these as one, so that what all of them instantiate is instantiated
# once; names in their anonymous namespaces must differ. Worth it where headers cost more than the code: those take about half the time.
function(fastball_together target)
  if(CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    list(GET ARGN 0 first)
    set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${first})
    # Said of types that a .cpp has for itself, once it is included.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# fastball_library(name SOURCES ... LIBRARIES ...): a static library, PUBLIC dependencies.
function(fastball_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ${ARG_LIBRARIES})
  fastball_settings(${name})
  fastball_precompiled(${name} fastball_library_headers)
endfunction()

# fastball_tool(name SOURCES ... LIBRARIES ...): an executable in build/bin that measures; installed where it was built.
function(fastball_tool name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES})
  fastball_settings(${name})
  fastball_precompiled(${name} fastball_program_headers)
  # Commands and main programs; what must be fast is in libraries.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  install(TARGETS ${name} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs OPTIONAL)
endfunction()

# fastball_program(name SOURCES ... LIBRARIES ...): the same for what the experiment needs, part of the target `programs`.
add_custom_target(programs)
function(fastball_program)
  fastball_tool(${ARGV})
  add_dependencies(programs ${ARGV0})
endfunction()

# fastball_export(name...): libraries for programs outside of this tree, as fastball::NAME after find_package(fastball), with all
# headers of the folder that says so.
function(fastball_export)
  foreach(name ${ARGN})
    string(REGEX REPLACE "^fastball_" "" exported ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${exported})
  endforeach()
  install(TARGETS ${ARGN} EXPORT fastball DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fastball COMPONENT development
    FILES_MATCHING PATTERN "*.h" PATTERN "calibration_file.h" EXCLUDE)
endfunction()

# fastball_test(name SOURCES ... LIBRARIES ... [NETWORK]): one GoogleTest program, one ctest per test case.
# NETWORK: each case runs in a network of its own (tests/in_own_network), so that runs cannot hear each other.
# CORES n: each case keeps so many busy, and others wait.
function(fastball_test name)
  cmake_parse_arguments(ARG "NETWORK" "TIMEOUT;CORES" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  fastball_settings(${name})
  fastball_precompiled(${name} fastball_test_headers)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${name} PRIVATE
    FASTBALL_SOURCE_DIR="${PROJECT_SOURCE_DIR}" FASTBALL_BIN_DIR="${CMAKE_BINARY_DIR}/bin")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(NOT ARG_CORES)
    set(ARG_CORES 1)
  endif()
  if(ARG_NETWORK)
    set_target_properties(${name} PROPERTIES CROSSCOMPILING_EMULATOR ${PROJECT_SOURCE_DIR}/tests/in_own_network)
  endif()
  include(GoogleTest)
  # Tests neither use nor fill the user's cache. Those that may take long begin first.
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${ARG_TIMEOUT} COST ${ARG_TIMEOUT} PROCESSORS ${ARG_CORES} ENVIRONMENT "XDG_CACHE_HOME=${CMAKE_BINARY_DIR}/test_cache")
endfunction()
