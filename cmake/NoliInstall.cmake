# SPDX-License-Identifier: Apache-2.0
# The libraries, their headers as <noli/LAYER/...>, the command, and what find_package(noli) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS noli_kernel noli_trajectory noli_proofs noli_flags noli_rounding EXPORT noliTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS noli noli_check noli_ccd_host noli_check_host RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(NOLI_WITH_HDF5)
  install(TARGETS noli_series RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
foreach(layer kernel trajectory proofs)
  install(DIRECTORY ${layer} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/noli FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES include/noli/ccd_plugin.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/noli)
install(TARGETS ${NOLI_CCD_PLUGINS} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/noli/ccd)
install(FILES LICENSE README.md THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/noli)
install(EXPORT noliTargets NAMESPACE noli:: DESTINATION ${config_dir})
configure_package_config_file(cmake/noliConfig.cmake.in ${CMAKE_BINARY_DIR}/noliConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/noliConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/noliConfig.cmake ${CMAKE_BINARY_DIR}/noliConfigVersion.cmake DESTINATION ${config_dir})
