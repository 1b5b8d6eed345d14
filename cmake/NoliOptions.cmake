# SPDX-License-Identifier: Apache-2.0
option(NOLI_BUILD_TESTS "Build the tests" ON)
option(NOLI_BUILD_BENCH "Build the benchmarks (needs Google Benchmark)" OFF)
option(NOLI_BUILD_FUZZERS "Build the libFuzzer targets (needs clang)" OFF)
set(NOLI_PARALLEL "TBB" CACHE STRING "Back end of the parallel layer: TBB or STD (std::thread; for ThreadSanitizer)")
set_property(CACHE NOLI_PARALLEL PROPERTY STRINGS TBB STD)
if(NOT NOLI_PARALLEL MATCHES "^(TBB|STD)$")
  message(FATAL_ERROR "NOLI_PARALLEL is '${NOLI_PARALLEL}'; expected TBB or STD")
endif()
set(NOLI_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
find_program(NOLI_CCACHE ccache)
mark_as_advanced(NOLI_CCACHE)
if(NOLI_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${NOLI_CCACHE}")
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# TEMPORARY-GROUND: lets the tree configure while a folder has no source yet
file(WRITE "${CMAKE_BINARY_DIR}/nothing.cpp" "")

# Headers are included as <noli/kernel/contact.h> in the build tree as they are once installed.
set(NOLI_INCLUDE_ROOT "${CMAKE_BINARY_DIR}/include")
file(MAKE_DIRECTORY "${NOLI_INCLUDE_ROOT}/noli")
foreach(layer kernel trajectory proofs audit app tests bench)
  file(CREATE_LINK "${CMAKE_SOURCE_DIR}/${layer}" "${NOLI_INCLUDE_ROOT}/noli/${layer}" SYMBOLIC)
endforeach()
