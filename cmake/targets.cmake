# mote_library(name SOURCES ... [LINK ...] [PRIVATE_LINK ...]): a static library of this project.
# mote_test(name SOURCES ... LINK ... [LABELS gpu]): a GoogleTest program whose cases ctest knows one by one.
add_library(mote_options INTERFACE)
target_compile_options(mote_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(mote_options INTERFACE -Wno-dangling-reference) # sees danger in find(name) that returns a reference
endif()
if(MOTE_WERROR)
  target_compile_options(mote_options INTERFACE -Werror)
endif()
if(MOTE_SANITIZE)
  target_compile_options(mote_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -g)
  target_link_options(mote_options INTERFACE -fsanitize=address,undefined)
endif()
target_compile_definitions(mote_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)
target_include_directories(mote_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)

function(mote_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE $<BUILD_INTERFACE:mote_options> ${ARG_PRIVATE_LINK})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

# One precompiled header for all tests: GoogleTest is most of what a test file compiles.
if(MOTE_BUILD_TESTS)
  add_library(mote_test_options INTERFACE)
  target_link_libraries(mote_test_options INTERFACE mote_options fmt::fmt glm::glm GTest::gmock GTest::gtest_main)
  target_compile_options(mote_test_options INTERFACE -O1 -fpch-preprocess)
  target_compile_definitions(mote_test_options INTERFACE MOTE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" MOTE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/test_pch.cpp CONTENT "int main() {}\n")
  add_executable(mote_test_pch ${PROJECT_BINARY_DIR}/test_pch.cpp)
  target_link_libraries(mote_test_pch PRIVATE mote_test_options)
  target_precompile_headers(mote_test_pch PRIVATE <gmock/gmock.h> <gtest/gtest.h> <algorithm> <array> <cmath> <cstring>
                            <filesystem> <fstream> <functional> <map> <random> <span> <string> <vector>)
endif()

function(mote_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/tests/environment.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LINK} mote_test_options)
  target_precompile_headers(${name} REUSE_FROM mote_test_pch)
  if(NOT ARG_LABELS) # an empty value would vanish from the list of properties and shift it
    set(ARG_LABELS unit)
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 120 LABELS "${ARG_LABELS}")
endfunction()
include(GoogleTest)
