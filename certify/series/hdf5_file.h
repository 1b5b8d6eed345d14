// SPDX-License-Identifier: Apache-2.0
//
// Named arrays of numbers as plain HDF5, without filters or chunks, so that any reader of HDF5 reads it:
//   h5py.File("series.h5")["energy/kinetic"][:], and its attribute "unit"
//
// What this does not do: it reports no error. Where HDF5 has one the program ends (ending.h).
#pragma once

#include <hdf5.h>

#include <vector>

#include "certify/series/stream_reader.h"

namespace noli::series {

class Hdf5File {
 public:
  /// The descriptor is a regular file, open for reading and writing. What is in it goes.
  explicit Hdf5File(int descriptor);

  /// The next array.
  void declare(const Array& array);
  /// Precondition: the reader gave the piece for this array, number `piece.array` of those declared.
  void write(const Array& array, const Piece& piece, const void* values);
  /// Nothing may follow.
  void close();

 private:
  hid_t file_;
  std::vector<hid_t> datasets_;
};

}  // namespace noli::series
