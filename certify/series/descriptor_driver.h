// SPDX-License-Identifier: Apache-2.0
//
// HDF5 on a file that is open already: the library knows a descriptor and no name, so it follows no link and opens no
// other file.
//
// What this does not do: it never tells the library that writing failed. The library does not always survive that, and
// the file is lost anyway: the program ends.
#pragma once

#include <hdf5.h>

namespace noli::series {

/// Sets access to files up to use the driver; the name that the library is given then means nothing. Precondition:
/// `file` is a regular file, open for reading and writing. `on_loss`: called with errno when it cannot be written or
/// read; must not return. One descriptor a process. Returns whether HDF5 took it.
bool use_descriptor(hid_t access, int file, void (*on_loss)(int error));

}  // namespace noli::series
