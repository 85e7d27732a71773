# How every target of the project is compiled.
add_library(vigil_compile INTERFACE)
add_library(vigil::compile ALIAS vigil_compile)

target_compile_options(vigil_compile INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wformat=2 -Werror
  # The same bytes from every preset: no fused multiply-add behind the source's back.
  -ffp-contract=off
  # g++ 12 sees an overlap in "literal" + std::string that cannot be (GCC bug 105651, fixed in 13).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
target_include_directories(vigil_compile INTERFACE "${PROJECT_SOURCE_DIR}")

if(VIGIL_SANITIZE)
  target_compile_options(vigil_compile INTERFACE
    -fsanitize=${VIGIL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(VIGIL_SANITIZE MATCHES undefined)
    # These four double the time that Eigen takes to compile. Bad pointers stop a program under the address sanitizer
    # all the same, and Eigen asserts the alignment that it needs.
    target_compile_options(vigil_compile INTERFACE -fno-sanitize=null,alignment,object-size,vptr)
  endif()
  target_link_options(vigil_compile INTERFACE -fsanitize=${VIGIL_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Another checkout of the same sources finds what this one compiled; precompiled headers may be cached too.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
    "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${CCACHE_PROGRAM}")
endif()
