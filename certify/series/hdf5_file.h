// SPDX-License-Identifier: Apache-2.0
//
// Writes named arrays of numbers as plain HDF5, without filters or chunks, so that any reader of HDF5 reads them:
//   h5py.File("series.h5")["energy/kinetic"][:], and its attribute "unit"
//
// Errors are not reported: if HDF5 has one, the program ends (ending.h).
#pragma once

#include <hdf5.h>

#include <vector>

#include "certify/series/stream_reader.h"

namespace noli::series {

class Hdf5File {
 public:
  /// Precondition: the descriptor is a regular file, open for reading and writing. Its contents are erased.
  explicit Hdf5File(int descriptor);

  void declare(const Array& array);
  /// Precondition: the reader gave the piece, and `array` is number `piece.array` of those declared.
  void write(const Array& array, const Piece& piece, const void* values);
  /// Nothing may follow.
  void close();

 private:
  hid_t file_;
  std::vector<hid_t> datasets_;
};

}  // namespace noli::series
