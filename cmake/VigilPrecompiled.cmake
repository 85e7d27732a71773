# With VIGIL_PRECOMPILE_HEADERS, what nearly every file includes is parsed once a build: in one set for the rooms, in
# another for their tests. Saves about a third of a sanitizer build; other builds do without, so that each file must
# include what it uses.

# Clang forgets that a precompiled template is the standard library's own, and warns of what it uses in private
# (std::stable_sort); ccache needs precompiled headers without a time in them.
set(vigil_precompiled_options
  "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>"
  "$<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>")

function(vigil_precompiled_set name)
  file(WRITE "${PROJECT_BINARY_DIR}/${name}.cpp" "")
  add_library(${name} OBJECT "${PROJECT_BINARY_DIR}/${name}.cpp")
  target_compile_options(${name} PRIVATE ${vigil_precompiled_options})
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

function(vigil_use_precompiled target set)
  if(VIGIL_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE ${vigil_precompiled_options})
    target_precompile_headers(${target} REUSE_FROM ${set})
  endif()
endfunction()

if(VIGIL_PRECOMPILE_HEADERS)
  vigil_precompiled_set(vigil_precompiled <algorithm> <cmath> <optional> <span> <string> <vector> <Eigen/Core>)
  target_link_libraries(vigil_precompiled PRIVATE vigil::compile Eigen3::Eigen)
  if(VIGIL_BUILD_TESTS)
    vigil_precompiled_set(vigil_precompiled_tests
      <algorithm> <cmath> <optional> <span> <string> <vector> <Eigen/Core> <gtest/gtest.h> <rapidcheck/gtest.h>)
    target_link_libraries(vigil_precompiled_tests PRIVATE vigil::compile Eigen3::Eigen GTest::gtest rapidcheck)
  endif()
endif()
