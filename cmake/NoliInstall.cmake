# SPDX-License-Identifier: Apache-2.0
# The libraries, the public headers, the command, and what find_package(noli) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS noli_kernel noli_trajectory noli_certificates noli_integrator noli_proofs noli_certify noli_flags
        EXPORT noliTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS noli_check EXPORT noliTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS noli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(NOLI_WITH_AUDIT)
  install(TARGETS noli_ccd_host noli_check_host RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # Nothing that ships stands on these, so a build of `noli` alone is installed without them.
  install(TARGETS ${NOLI_CCD_PLUGINS} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/noli/ccd OPTIONAL)
endif()
if(NOLI_WITH_HDF5)
  install(TARGETS noli_series RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY include/noli DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY scenes schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/noli)
install(FILES LICENSE README.md THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/noli)
install(EXPORT noliTargets NAMESPACE noli:: DESTINATION ${config_dir})
set(NOLI_SCENES ${CMAKE_INSTALL_DATADIR}/noli/scenes)
configure_package_config_file(cmake/noliConfig.cmake.in ${CMAKE_BINARY_DIR}/noliConfig.cmake INSTALL_DESTINATION ${config_dir}
                              PATH_VARS NOLI_SCENES)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/noliConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/noliConfig.cmake ${CMAKE_BINARY_DIR}/noliConfigVersion.cmake DESTINATION ${config_dir})
