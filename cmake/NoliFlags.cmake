# SPDX-License-Identifier: Apache-2.0
# What every target of the project is compiled with.
add_library(noli_flags INTERFACE)
add_library(noli::flags ALIAS noli_flags)
set_target_properties(noli_flags PROPERTIES EXPORT_NAME flags)

# Same bits everywhere: nothing may fuse or re-order floating-point operations. Public headers have no such operations, so
# only C++20 travels with the exported targets.
target_compile_options(noli_flags INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>>)
target_compile_definitions(noli_flags INTERFACE $<BUILD_INTERFACE:EIGEN_MPL2_ONLY>)
target_compile_features(noli_flags INTERFACE cxx_std_20)

# For code that switches the rounding mode, so that the compiler neither folds nor moves an operation across the switch.
add_library(noli_rounding INTERFACE)
target_compile_options(noli_rounding INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-frounding-math>)
# CGAL would end the program before main() where rounding cannot be switched; kernel/arithmetic/rounding.h finds that out and says so.
target_compile_definitions(noli_rounding INTERFACE CGAL_DISABLE_ROUNDING_MATH_CHECK)

add_library(noli_warnings INTERFACE)
target_compile_options(noli_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlapping copies in the concatenation of strings where there are none.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)

if(NOLI_SANITIZE)
  add_compile_options(-fsanitize=${NOLI_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${NOLI_SANITIZE})
  if(NOLI_SANITIZE_WITHOUT)
    add_compile_options(-fno-sanitize=${NOLI_SANITIZE_WITHOUT})
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")  # g++ defines them itself
    foreach(kind IN ITEMS address thread)
      if(NOLI_SANITIZE MATCHES "${kind}")
        string(TOUPPER "__SANITIZE_${kind}__=1" definition)
        add_compile_definitions(${definition})
      endif()
    endforeach()
  endif()
endif()
