# SPDX-License-Identifier: Apache-2.0
option(NOLI_BUILD_TESTS "Build the tests" ON)
option(NOLI_WITH_AUDIT "Build `noli audit` and `noli fuzz`" ON)
option(NOLI_BUILD_BENCH "Build the benchmarks (needs Google Benchmark)" OFF)
option(NOLI_BUILD_FUZZERS "Build the libFuzzer targets (needs clang)" OFF)
if(NOT NOLI_WITH_AUDIT AND (NOLI_BUILD_TESTS OR NOLI_BUILD_BENCH OR NOLI_BUILD_FUZZERS))
  message(FATAL_ERROR "NOLI_WITH_AUDIT is OFF, but tests, benchmarks and fuzzers need it")
endif()
set(NOLI_PARALLEL "TBB" CACHE STRING "Back end of the parallel layer: TBB or STD (std::thread; for ThreadSanitizer)")
set_property(CACHE NOLI_PARALLEL PROPERTY STRINGS TBB STD)
if(NOT NOLI_PARALLEL MATCHES "^(TBB|STD)$")
  message(FATAL_ERROR "NOLI_PARALLEL is '${NOLI_PARALLEL}'; expected TBB or STD")
endif()
set(NOLI_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them, e.g. address,undefined")
# Some checks look at each reference, which makes code full of small vectors several times slower. Where AddressSanitizer is on, it finds a
# null or a place outside of any object at the access itself. Alignment stays with the fuzzers, which give bytes to readers.
set(NOLI_SANITIZE_WITHOUT "" CACHE STRING "Checks of these sanitizers to leave out, as -fno-sanitize takes them, e.g. object-size")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# Decided by the first configuration: with a compiler cache that is installed later (by the set-up of scripts/test, after scripts/demo), every
# compile command would change, and everything would be compiled again.
if(NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(NOLI_CCACHE ccache NO_CACHE)
  if(NOT NOLI_CCACHE)
    set(NOLI_CCACHE "")
  endif()
  set(CMAKE_CXX_COMPILER_LAUNCHER "${NOLI_CCACHE}" CACHE STRING "Program that starts the compiler, e.g. ccache; may be empty")
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Headers are included by their place in the project, "kernel/motion.h"; public ones as users do, <noli/contact.h>.
set(NOLI_INCLUDE_DIRS "${CMAKE_SOURCE_DIR};${CMAKE_SOURCE_DIR}/include")
