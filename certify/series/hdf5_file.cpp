// SPDX-License-Identifier: Apache-2.0
#include "certify/series/hdf5_file.h"

#include "certify/series/descriptor_driver.h"
#include "certify/series/ending.h"

namespace noli::series {
namespace {

/// Checks a return value of HDF5, a handle or a status. Handles of small objects are not closed, as the program is
/// short.
template <class Said>
Said require(Said said, const std::string& what) {
  if (said < 0) end_with(Ending::failure, "HDF5 fails: " + what);
  return said;
}

void write_unit(hid_t dataset, const Array& array) {
  const hid_t type = require(H5Tcopy(H5T_C_S1), array.name);
  require(H5Tset_size(type, H5T_VARIABLE), array.name);
  require(H5Tset_cset(type, H5T_CSET_UTF8), array.name);
  const hid_t space = require(H5Screate(H5S_SCALAR), array.name);
  const hid_t unit = require(H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT), array.name);
  const char* text = array.unit.c_str();
  require(H5Awrite(unit, type, &text), array.name);
  require(H5Aclose(unit), array.name);
  H5Sclose(space);
  H5Tclose(type);
}

/// The place of a piece: along the first index, or a part of one row along the second.
struct Box {
  std::vector<hsize_t> start, count;

  Box(const Shape& shape, const Piece& piece) : start(shape.size(), 0), count(shape.begin(), shape.end()) {
    const std::uint64_t row = product_from(shape, 1), inner = product_from(shape, 2);
    start[0] = piece.first / row;
    count[0] = 1;
    if (piece.count % row == 0) {
      count[0] = piece.count / row;
    } else {
      start[1] = piece.first % row / inner;
      count[1] = piece.count / inner;
    }
  }
};

}  // namespace

Hdf5File::Hdf5File(int descriptor) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // one line is enough
  const hid_t access = require(H5Pcreate(H5P_FILE_ACCESS), "the file");
  if (!use_descriptor(access, descriptor, end_lost)) require(-1, "its driver");
  file_ = require(H5Fcreate("series", H5F_ACC_TRUNC, H5P_DEFAULT, access), "the file");
}

void Hdf5File::declare(const Array& array) {
  const std::vector<hsize_t> extents(array.shape.begin(), array.shape.end());
  const hid_t space = require(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), array.name);
  const hid_t links = require(H5Pcreate(H5P_LINK_CREATE), array.name);
  const hid_t properties = require(H5Pcreate(H5P_DATASET_CREATE), array.name);
  require(H5Pset_create_intermediate_group(links, 1), array.name);
  // Contiguous and allocated at once. Not filled with zeros, which would take as long as the values. No time of day in
  // the file.
  require(H5Pset_layout(properties, H5D_CONTIGUOUS), array.name);
  require(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), array.name);
  require(H5Pset_obj_track_times(properties, false), array.name);
  const hid_t type = array.type == Type::f64 ? H5T_IEEE_F64LE : H5T_STD_I64LE;
  datasets_.push_back(
      require(H5Dcreate2(file_, array.name.c_str(), type, space, links, properties, H5P_DEFAULT), array.name));
  write_unit(datasets_.back(), array);
  H5Pclose(properties);
  H5Pclose(links);
  H5Sclose(space);
}

void Hdf5File::write(const Array& array, const Piece& piece, const void* values) {
  const hid_t dataset = datasets_[piece.array];
  const hid_t space = require(H5Dget_space(dataset), array.name);
  const Box box(array.shape, piece);
  const hsize_t size = piece.count;
  const hid_t memory = require(H5Screate_simple(1, &size, nullptr), array.name);
  require(H5Sselect_hyperslab(space, H5S_SELECT_SET, box.start.data(), nullptr, box.count.data(), nullptr), array.name);
  const hid_t type = array.type == Type::f64 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
  require(H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, values), array.name);
  H5Sclose(memory);
  H5Sclose(space);
}

void Hdf5File::close() {
  for (const hid_t dataset : datasets_) require(H5Dclose(dataset), "an array");
  require(H5Fflush(file_, H5F_SCOPE_LOCAL), "the file");
  require(H5Fclose(file_), "the file");
}

}  // namespace noli::series
