# vigil_fuzzer(NAME SOURCES ... [DEPENDS ...])
#
# A libFuzzer program (clang, preset "asan-ubsan") that `./test` runs from the seeds in fuzz/corpus/NAME, which must exist.
# The rooms it depends on are instrumented by the preset. `fuzzers` builds them all; fuzzers.txt in the build folder
# names them, one a line.
function(vigil_fuzzer name)
  cmake_parse_arguments(PARSE_ARGV 1 FUZZER "" "" "SOURCES;DEPENDS")
  file(GLOB seeds "${PROJECT_SOURCE_DIR}/fuzz/corpus/${name}/*")
  if(NOT seeds)
    message(FATAL_ERROR "vigil_fuzzer(${name}): no seeds in fuzz/corpus/${name}/")
  endif()
  add_executable(${name} ${FUZZER_SOURCES})
  target_link_libraries(${name} PRIVATE vigil::compile ${FUZZER_DEPENDS})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/fuzz")
  add_dependencies(fuzzers ${name})
  set_property(TARGET fuzzers APPEND PROPERTY VIGIL_NAMES ${name})
endfunction()

if(VIGIL_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "Fuzz targets need clang: cmake --preset asan-ubsan")
  endif()
  add_custom_target(fuzzers)
  target_compile_options(vigil_compile INTERFACE -fsanitize=fuzzer-no-link)
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/fuzzers.txt" CONTENT "$<JOIN:$<TARGET_PROPERTY:fuzzers,VIGIL_NAMES>,\n>\n")
endif()
