# SPDX-License-Identifier: Apache-2.0
# The C library of HDF5 as target noli_external::hdf5, if it is there; NOLI_HDF5_FOUND says whether. Only the library itself is
# linked, not what it stands on.
find_path(NOLI_HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(NOLI_HDF5_LIBRARY NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial)
mark_as_advanced(NOLI_HDF5_INCLUDE_DIR NOLI_HDF5_LIBRARY)
if(NOLI_HDF5_INCLUDE_DIR AND NOLI_HDF5_LIBRARY)
  set(NOLI_HDF5_FOUND ON)
  if(NOT TARGET noli_external::hdf5)
    add_library(noli_external::hdf5 UNKNOWN IMPORTED)
    set_target_properties(noli_external::hdf5 PROPERTIES
      IMPORTED_LOCATION "${NOLI_HDF5_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${NOLI_HDF5_INCLUDE_DIR}")
  endif()
else()
  set(NOLI_HDF5_FOUND OFF)
endif()
