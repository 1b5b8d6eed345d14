# SPDX-License-Identifier: Apache-2.0
# What is installed, in components, each of which is a Debian package (packaging/): `runtime`, the programs and what they read; `dev`,
# libraries, public headers, and what find_package(noli) reads; `mpi`; `python`; `doc`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

install(TARGETS noli_kernel noli_trajectory noli_certificates noli_integrator noli_proofs noli_certify noli_flags
        EXPORT noliTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(TARGETS noli_check EXPORT noliTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(TARGETS noli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
if(NOLI_WITH_AUDIT)
  install(TARGETS noli_ccd_host noli_check_host RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
  # Nothing that ships stands on these, so a build of `noli` alone is installed without them.
  install(TARGETS ${NOLI_CCD_PLUGINS} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/noli/ccd COMPONENT ccd OPTIONAL)
endif()
if(NOLI_WITH_HDF5)
  install(TARGETS noli_series RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
endif()
if(NOLI_WITH_MPI)
  install(TARGETS noli_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/noli COMPONENT mpi)
endif()
if(NOLI_WITH_PYTHON)
  set(python_dir lib/python3/dist-packages/noli)
  install(TARGETS noli_python LIBRARY DESTINATION ${python_dir} COMPONENT python)
  install(DIRECTORY python/noli/ DESTINATION ${python_dir} COMPONENT python FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed"
          PATTERN "__pycache__" EXCLUDE)
endif()
install(DIRECTORY include/noli DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev FILES_MATCHING PATTERN "*.h")
install(DIRECTORY scenes schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/noli COMPONENT runtime)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT dev)
install(FILES LICENSE README.md THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/noli)
install(EXPORT noliTargets NAMESPACE noli:: DESTINATION ${config_dir} COMPONENT dev)
set(NOLI_SCENES ${CMAKE_INSTALL_DATADIR}/noli/scenes)
configure_package_config_file(cmake/noliConfig.cmake.in ${CMAKE_BINARY_DIR}/noliConfig.cmake INSTALL_DESTINATION ${config_dir}
                              PATH_VARS NOLI_SCENES)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/noliConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/noliConfig.cmake ${CMAKE_BINARY_DIR}/noliConfigVersion.cmake DESTINATION ${config_dir} COMPONENT dev)
include(${CMAKE_SOURCE_DIR}/packaging/NoliPackages.cmake)
