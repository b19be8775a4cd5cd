# The functions every module, application and test of Pneuma is declared with.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Warnings and sanitizers for our own code only. Results must not depend on whether the compiler
# fuses a multiplication with an addition, hence -ffp-contract=off.
add_library(pneuma_compile_options INTERFACE)
target_compile_options(
  pneuma_compile_options
  INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -ffp-contract=off
            $<$<BOOL:${PNEUMA_WERROR}>:-Werror>)
if(PNEUMA_SANITIZE) # a list with commas, which a generator expression would take for arguments
  target_compile_options(pneuma_compile_options INTERFACE -fsanitize=${PNEUMA_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(pneuma_compile_options INTERFACE -fsanitize=${PNEUMA_SANITIZE})
endif()

# pneuma_precompile(<target> [<header> ...])
# Compiles the standard library, Eigen and the headers given once for the target instead of once for
# every source. A source includes what it uses all the same: presets core-only and asan do without.
function(pneuma_precompile target)
  if(PNEUMA_PRECOMPILE)
    target_precompile_headers(
      ${target} PRIVATE <algorithm> <array> <chrono> <filesystem> <functional> <map> <memory>
      <optional> <string> <vector> <Eigen/Core> <Eigen/Geometry> <Eigen/LU> ${ARGN})
    # GCC 12 takes std::string for an overflow once it is precompiled.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                           -Wno-stringop-overread -Wno-maybe-uninitialized)
  endif()
endfunction()

# pneuma_unite(<target>)
# With PNEUMA_UNITY: sources of the target are compiled sixteen at a time, which halves a whole build and
# makes the rebuild after one changed file longer. For targets whose sources repeat the same templates.
function(pneuma_unite target)
  if(PNEUMA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
  endif()
endfunction()

# pneuma_compile_quickly(<target>)
# For what is not shipped and calculates little: half of the time that GCC takes for it goes into optimizing.
function(pneuma_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O0>)
endfunction()

# pneuma_add_headers_alone(<name> HEADERS ... [PRECOMPILE ...])
# Built by the target `headers_alone`: every header in a source of its own, with nothing but what the
# module passes on. Only Eigen and PRECOMPILE, which most of them include, are compiled once for all.
add_custom_target(headers_alone)
function(pneuma_add_headers_alone name)
  cmake_parse_arguments(arg "" "" "HEADERS;PRECOMPILE" ${ARGN})
  set(sources)
  foreach(header IN LISTS arg_HEADERS)
    string(MAKE_C_IDENTIFIER "${header}" source)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/headers_alone/${source}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include \"${name}/${header}\"\n")
    list(APPEND sources "${source}")
  endforeach()
  set(target pneuma_${name}_headers_alone)
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(${target} PRIVATE pneuma::${name})
  target_compile_options(${target} PRIVATE -O0)
  if(PNEUMA_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <Eigen/LU>
                                                 ${arg_PRECOMPILE})
  endif()
  add_dependencies(headers_alone ${target})
endfunction()

# pneuma_add_module(<name> [UNITE] [HEADERS ...] [SOURCES ...] [PUBLIC ...] [PRIVATE ...] [PRECOMPILE ...])
# A static library pneuma::<name> whose headers are included as "<name>/header.h". It is exported: outside projects
# have it by find_package(Pneuma), once the component `dev` is installed (cmake/Export.cmake).
# UNITE: see pneuma_unite.
# PRECOMPILE: headers of libraries that most of its sources include.
function(pneuma_add_module name)
  cmake_parse_arguments(arg "UNITE" "" "HEADERS;SOURCES;PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  set(target pneuma_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:pneuma_compile_options> ${arg_PRIVATE})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    pneuma_precompile(${target} ${arg_PRECOMPILE})
    if(arg_UNITE)
      pneuma_unite(${target})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(pneuma::${name} ALIAS ${target})
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/modules"
                                                             FILES ${arg_HEADERS})
  target_link_libraries(${target} ${scope} ${arg_PUBLIC})
  target_compile_features(${target} ${scope} cxx_std_20)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT PneumaTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
          FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pneuma" COMPONENT dev)
  list(FILTER arg_PRECOMPILE INCLUDE REGEX "nlohmann")  # the one library that headers show
  # A source that is compiled by itself includes its own header first (clang-format sees to that), which
  # compiles the header alone.
  set(alone ${arg_HEADERS})
  if(NOT (arg_UNITE AND PNEUMA_UNITY))
    foreach(source IN LISTS arg_SOURCES)
      string(REGEX REPLACE "[.]cpp$" ".h" header "${source}")
      list(REMOVE_ITEM alone "${header}")
    endforeach()
  endif()
  if(alone)
    pneuma_add_headers_alone(${name} HEADERS ${alone} PRECOMPILE ${arg_PRECOMPILE})
  endif()
endfunction()

# pneuma_time_limit(<variable> <seconds> [FULL s] [SANITIZED s])
# How long a test may take: longer where PNEUMA_FULL_TESTS or sanitizers give it more to do.
function(pneuma_time_limit variable seconds)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "FULL;SANITIZED" "")
  set(most ${seconds})
  if(PNEUMA_FULL_TESTS AND arg_FULL)
    set(most ${arg_FULL})
  endif()
  if(PNEUMA_SANITIZE AND arg_SANITIZED)
    set(most ${arg_SANITIZED})
  endif()
  set(${variable} ${most} PARENT_SCOPE)
endfunction()

# pneuma_add_test(<name> SOURCES ... LINK ... [LABELS ...] [TOGETHER ...] [RENDER] [UNITE] [QUICK])
# One GoogleTest executable; its cases become CTest tests "<name>/Suite.Case".
# TOGETHER: suites whose cases share what takes long to make: each is one test "<name>/Suite", one process.
# UNITE: see pneuma_unite; no two sources may call different helpers by one name.
# QUICK: see pneuma_compile_quickly.
# RENDER: runs under Xvfb, and is registered only where xvfb-run exists.
function(pneuma_add_test name)
  cmake_parse_arguments(arg "RENDER;UNITE;QUICK" "" "SOURCES;LINK;LABELS;TOGETHER" ${ARGN})
  if(arg_RENDER AND NOT PNEUMA_XVFB_RUN)
    message(STATUS "tests ${name}: not registered, xvfb-run is missing")
    return()
  endif()
  set(target pneuma_${name}_test)
  add_executable(${target} ${arg_SOURCES})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${target} PRIVATE pneuma_compile_options ${arg_LINK} GTest::gtest
                                          GTest::gmock GTest::gtest_main)
  if(arg_LINK MATCHES "pneuma")  # else Eigen is not known to it
    pneuma_precompile(${target} <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  if(arg_QUICK)
    pneuma_compile_quickly(${target})
  endif()
  if(arg_UNITE)
    pneuma_unite(${target})
  endif()
  if(arg_RENDER)
    # One process for all cases: starting an X server for each would cost more than the cases.
    add_test(NAME ${name} COMMAND ${PNEUMA_XVFB_RUN} -a -s "-screen 0 1600x1000x24"
                                  $<TARGET_FILE:${target}>)
    pneuma_time_limit(most 600 FULL 7200) # more actions and cycles
    set_tests_properties(${name} PROPERTIES LABELS "${name};render;${arg_LABELS}" TIMEOUT ${most}
                         ENVIRONMENT "${PNEUMA_TEST_ENVIRONMENT}")
  else()
    set(alone "*-")
    foreach(suite IN LISTS arg_TOGETHER)
      string(APPEND alone ":${suite}.*:*/${suite}.*")
      add_test(NAME ${name}/${suite} COMMAND ${target} "--gtest_filter=${suite}.*:*/${suite}.*")
      set_tests_properties(
        ${name}/${suite} PROPERTIES TIMEOUT 3600 LABELS "${name};${arg_LABELS}"
                                    FAIL_REGULAR_EXPRESSION "Running 0 tests"
                                    ENVIRONMENT "${PNEUMA_TEST_ENVIRONMENT}")
    endforeach()
    include(GoogleTest)
    gtest_discover_tests(
      ${target}
      TEST_PREFIX ${name}/
      TEST_FILTER "${alone}"
      DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT 600)
    # Lists do not survive the discovery as one value, so they are set after it.
    set(lists "${CMAKE_CURRENT_BINARY_DIR}/${target}_lists.cmake")
    file(CONFIGURE OUTPUT "${lists}" @ONLY CONTENT [[
set_tests_properties(${@target@_TESTS} PROPERTIES LABELS "@name@;@arg_LABELS@"
                     ENVIRONMENT "@PNEUMA_TEST_ENVIRONMENT@")
]])
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${lists}")
  endif()
endfunction()
