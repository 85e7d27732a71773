# vigil_room(NAME [SOURCES ...] [TESTS ...] [DEPENDS ...] [PRIVATE_DEPENDS ...] [TEST_DEPENDS ...])
#
# One room of the folder tree: library vigil::NAME from SOURCES (an interface library when there
# are none) and, from TESTS, one test program NAME_test that ctest runs under the label "quick".
function(vigil_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "SOURCES;TESTS;DEPENDS;PRIVATE_DEPENDS;TEST_DEPENDS")
  if(ROOM_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "vigil_room(${name}): unknown arguments ${ROOM_UNPARSED_ARGUMENTS}")
  endif()
  if(ROOM_SOURCES)
    add_library(vigil_${name} STATIC ${ROOM_SOURCES})
    target_link_libraries(vigil_${name} PUBLIC vigil::compile ${ROOM_DEPENDS} PRIVATE ${ROOM_PRIVATE_DEPENDS})
    vigil_use_precompiled(vigil_${name} vigil_precompiled)
  else()
    add_library(vigil_${name} INTERFACE)
    target_link_libraries(vigil_${name} INTERFACE vigil::compile ${ROOM_DEPENDS})
  endif()
  add_library(vigil::${name} ALIAS vigil_${name})
  if(ROOM_TESTS AND VIGIL_BUILD_TESTS)
    vigil_test(${name}_test SOURCES ${ROOM_TESTS} DEPENDS vigil::${name} ${ROOM_TEST_DEPENDS})
  endif()
endfunction()

# vigil_test(NAME SOURCES ... [DEPENDS ...] [LABEL quick|full] [TIMEOUT seconds])
#
# A GoogleTest program that ctest runs as one test. `quick_tests` and `full_tests` build those of a label.
function(vigil_test name)
  cmake_parse_arguments(PARSE_ARGV 1 TEST "" "LABEL;TIMEOUT" "SOURCES;DEPENDS")
  if(NOT TEST_LABEL)
    set(TEST_LABEL quick)
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 300)
  endif()
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_DEPENDS} GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    VIGIL_REFERENCE_DIR="${PROJECT_SOURCE_DIR}/vigil/testing/reference"
    VIGIL_MISSIONS_DIR="${PROJECT_SOURCE_DIR}/missions")
  vigil_use_precompiled(${name} vigil_precompiled_tests)
  add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
  # The same random cases in every run; without it rapidcheck draws a new seed each time, and prints it.
  set_tests_properties(${name} PROPERTIES LABELS ${TEST_LABEL} TIMEOUT ${TEST_TIMEOUT}
    ENVIRONMENT "RC_PARAMS=seed=20251122")
  add_dependencies(${TEST_LABEL}_tests ${name})
endfunction()

# vigil_cli_test(NAME COMMAND ... [TIMEOUT seconds])
#
# A command that ctest runs under the label "cli", in the release preset of `./test`. The program's path: $<TARGET_FILE:vigil>.
function(vigil_cli_test name)
  cmake_parse_arguments(PARSE_ARGV 1 TEST "" "TIMEOUT" "COMMAND")
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 300)
  endif()
  add_test(NAME ${name} COMMAND ${TEST_COMMAND})
  set_tests_properties(${name} PROPERTIES LABELS cli TIMEOUT ${TEST_TIMEOUT})
endfunction()

if(VIGIL_BUILD_TESTS)
  add_custom_target(quick_tests)
  add_custom_target(full_tests)
endif()
