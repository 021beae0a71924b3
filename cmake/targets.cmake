# mote_library(name SOURCES ... [LINK ...] [PRIVATE_LINK ...]): a static library of this project.
# mote_test(name SOURCES ... LINK ... [LABELS gpu]): a GoogleTest program whose cases ctest knows one by one.
add_library(mote_options INTERFACE)
target_compile_options(mote_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
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

function(mote_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} mote_options GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE MOTE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" MOTE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 120 LABELS "${ARG_LABELS}"
                       ENVIRONMENT "${MOTE_TEST_ENVIRONMENT}")
endfunction()
include(GoogleTest)
# Tests run on lavapipe with the validation layer on, whatever else the machine has.
set(MOTE_TEST_ENVIRONMENT "MOTE_ADAPTER=llvmpipe;MOTE_VALIDATION=1;LC_ALL=C.UTF-8")
