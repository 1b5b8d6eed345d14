# SPDX-License-Identifier: Apache-2.0
# What every target of the project is compiled with.
add_library(noli_flags INTERFACE)

# Same bits everywhere: nothing may fuse or re-order floating-point operations. This one travels with the exported targets,
# because the kernel's templates are compiled in the user's translation units too.
target_compile_options(noli_flags INTERFACE -ffp-contract=off)
target_compile_definitions(noli_flags INTERFACE EIGEN_MPL2_ONLY)

add_library(noli_warnings INTERFACE)
target_compile_options(noli_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)

if(NOLI_SANITIZE)
  add_compile_options(-fsanitize=${NOLI_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${NOLI_SANITIZE})
endif()
