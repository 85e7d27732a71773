# vigil_benchmark(NAME SOURCES ... [DEPENDS ...])
#
# A Google Benchmark program without a main of its own: bench/main.cpp adds commit, compiler and flags to what it
# reports. ctest runs it once, briefly, under the label "full": a benchmark checks its answers before it times them.
function(vigil_benchmark name)
  cmake_parse_arguments(PARSE_ARGV 1 BENCHMARK "" "" "SOURCES;DEPENDS")
  add_executable(${name} ${BENCHMARK_SOURCES})
  target_link_libraries(${name} PRIVATE vigil::compile vigil_benchmark_main benchmark::benchmark ${BENCHMARK_DEPENDS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bench")
  if(VIGIL_BUILD_TESTS)
    add_test(NAME ${name} COMMAND ${name} --benchmark_min_time=0.001)
    set_tests_properties(${name} PROPERTIES LABELS full TIMEOUT 300)
  endif()
endfunction()
