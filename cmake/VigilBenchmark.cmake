# vigil_benchmark(NAME SOURCES ... [DEPENDS ...] [TEST_FILTER REGEX])
#
# A Google Benchmark program without a main of its own: bench/main.cpp adds commit, compiler and flags to what it
# reports. ctest runs it once, briefly, under the label "full": a benchmark checks its answers before it times them.
# TEST_FILTER: only those whose names match are run there.
function(vigil_benchmark name)
  cmake_parse_arguments(PARSE_ARGV 1 BENCHMARK "" "TEST_FILTER" "SOURCES;DEPENDS")
  add_executable(${name} ${BENCHMARK_SOURCES})
  target_link_libraries(${name} PRIVATE vigil::compile vigil_benchmark_main benchmark::benchmark ${BENCHMARK_DEPENDS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bench")
  if(VIGIL_BUILD_TESTS)
    if(NOT BENCHMARK_TEST_FILTER)
      set(BENCHMARK_TEST_FILTER .)
    endif()
    add_test(NAME ${name} COMMAND ${name} --benchmark_min_time=0.001 "--benchmark_filter=${BENCHMARK_TEST_FILTER}")
    set_tests_properties(${name} PROPERTIES LABELS full TIMEOUT 300)
  endif()
endfunction()
