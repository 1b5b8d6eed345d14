# SPDX-License-Identifier: Apache-2.0
# Debian packages by CPack: noli, libnoli-dev, noli-mpi, python3-noli, noli-doc. `scripts/package` makes them; what it generates (man pages, completions, the
# documentation, copyright and changelogs as Debian wants them) lies in build/packages/generated, and is installed only where it is.
set(generated "${CMAKE_SOURCE_DIR}/build/packages/generated")
foreach(package noli libnoli-dev noli-mpi python3-noli noli-doc)
  set(component runtime)
  if(package STREQUAL libnoli-dev)
    set(component dev)
  elseif(package STREQUAL noli-mpi)
    set(component mpi)
  elseif(package STREQUAL python3-noli)
    set(component python)
  elseif(package STREQUAL noli-doc)
    set(component doc)
  endif()
  install(DIRECTORY "${generated}/${package}/" DESTINATION . COMPONENT ${component} OPTIONAL
          FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME noli)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "certify exactly that moving meshes do not touch")
set(CPACK_PACKAGE_CONTACT "The Noli authors <noli@example.org>")
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_SOURCE_DIR}/build/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL runtime dev doc)
if(NOLI_WITH_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(NOLI_WITH_MPI)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME noli)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "noli-doc, noli-mpi, libnoli-dev")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Noli decides in exact arithmetic whether anything touched between the frames
of a simulation, and writes a proof that a separate checker verifies. It also
simulates scenes with certified contact, fuzzes collision detection libraries
and audits how far their answers and floating-point numbers can be trusted.")
math(EXPR python_after "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libnoli-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "noli (= ${PROJECT_VERSION}), libcgal-dev, libfmt-dev, libgmp-dev, libmpfr-dev, libpugixml-dev, libtbb-dev, libzip-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "C++ headers and static libraries of Noli: exact continuous collision detection
for CGAL users, verification of frames in memory or in a solver's loop,
certified simulation, and proofs; with examples and a CMake package.")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME noli-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "noli (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_DEBIAN_MPI_DESCRIPTION "Noli on many machines: with this library, mpirun noli verify and mpirun noli
check share the steps of a motion out to all ranks of a job. The answer is that
of one process, byte for byte.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-noli)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "noli (= ${PROJECT_VERSION}), python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}~), python3 (<< ${Python_VERSION_MAJOR}.${python_after}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-tqdm, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Noli for Python: arrays to verdict, exactly and with a proof. Frames as arrays,
generators or files, contact queries by the million, steps of a solver,
certified simulation and repair, and audits of Python functions for collision
detection.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME noli-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "Tutorials for certifying frames, simulating, fuzzing, auditing and checking
proofs with Noli, and reference pages for commands, formats and the C++ API.")
include(CPack)
cpack_add_component(runtime)
cpack_add_component(dev DEPENDS runtime)
cpack_add_component(mpi DEPENDS runtime)
cpack_add_component(python DEPENDS runtime)
cpack_add_component(doc)
