// SPDX-License-Identifier: Apache-2.0
//
// Lets HDF5 work on a file that is already open: the library has a descriptor and no name, so it follows no link and
// opens no other file.
//
// When writing fails, the program ends instead of reporting to the library, which does not always survive that. The
// file is lost anyway.
#pragma once

#include <hdf5.h>

namespace noli::series {

/// Makes `access` use the driver, which ignores the name passed to the library. Precondition: `file` is a regular file,
/// open for what is done with it. `on_loss`: called with errno when it cannot be written or read; must not return. A
/// process can use one descriptor. Returns whether HDF5 accepted it.
bool use_descriptor(hid_t access, int file, void (*on_loss)(int error));

}  // namespace noli::series
