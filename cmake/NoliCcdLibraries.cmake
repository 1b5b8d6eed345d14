# SPDX-License-Identifier: Apache-2.0
# Collision detection by others, for plug-ins of `noli audit ccd` over it (audit/ccd/plugins).
include("${CMAKE_CURRENT_LIST_DIR}/NoliPart.cmake")
find_package(fcl QUIET)
noli_part(NOLI_WITH_FCL FCL "${fcl_FOUND}" "Build the plug-in over FCL for `noli audit ccd`" "its fcl-config.cmake (Debian: libfcl-dev)")

option(NOLI_WITH_IPC_TOOLKIT "Build the plug-in over the IPC Toolkit for `noli audit ccd` (needs the toolkit)" OFF)
set(NOLI_IPC_TOOLKIT_SOURCE "" CACHE PATH "The IPC Toolkit's sources, where it is no package that CMake finds")
if(NOLI_WITH_IPC_TOOLKIT)
  find_package(ipc_toolkit QUIET)
  if(NOT TARGET ipc::toolkit AND NOLI_IPC_TOOLKIT_SOURCE)
    if(NOT EXISTS "${NOLI_IPC_TOOLKIT_SOURCE}/CMakeLists.txt")
      message(FATAL_ERROR "NOLI_IPC_TOOLKIT_SOURCE is '${NOLI_IPC_TOOLKIT_SOURCE}'; expected a folder with the IPC Toolkit's "
                          "CMakeLists.txt (a clone of https://github.com/ipc-sim/ipc-toolkit, v1.4.0)")
    endif()
    add_subdirectory("${NOLI_IPC_TOOLKIT_SOURCE}" ipc_toolkit EXCLUDE_FROM_ALL)
  endif()
  if(NOT TARGET ipc::toolkit)
    message(FATAL_ERROR "NOLI_WITH_IPC_TOOLKIT is ON, but there is no IPC Toolkit; expected a package ipc_toolkit with the target "
                        "ipc::toolkit (CMAKE_PREFIX_PATH says where), or NOLI_IPC_TOOLKIT_SOURCE, a clone of "
                        "https://github.com/ipc-sim/ipc-toolkit, v1.4.0")
  endif()
endif()
