// SPDX-License-Identifier: Apache-2.0
#include "noli/trajectory/series_file.h"

#include <hdf5.h>

#include <functional>
#include <numeric>
#include <stdexcept>
#include <system_error>

namespace noli {
namespace {

/// A handle of HDF5, closed in the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closes)(hid_t)) : id_(id), close_(closes) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }
  bool is_open() const { return id_ >= 0; }
  /// Closes it now; whether that succeeded (it may have to write).
  bool close() {
    const bool closed = id_ >= 0 && close_(id_) >= 0;
    id_ = -1;
    return closed;
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

std::vector<hsize_t> extents(const SeriesShape& shape) { return {shape.begin(), shape.end()}; }

/// Contiguous; no zeros written before the values, which would take as long as the values, at once; no time of day in
/// the file.
bool make_plain(hid_t properties) {
  return H5Pset_layout(properties, H5D_CONTIGUOUS) >= 0 && H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER) >= 0 &&
         H5Pset_obj_track_times(properties, false) >= 0;
}

bool write_unit(hid_t dataset, const std::string& unit) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0) return false;
  const Handle attribute(H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* text = unit.c_str();
  return attribute.is_open() && H5Awrite(attribute, type, &text) >= 0;
}

}  // namespace

struct SeriesFile::Impl {
  explicit Impl(const std::filesystem::path& target)
      : path(target),
        part(target.string() + ".part"),
        file(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {
    if (!file.is_open()) fail("");
  }

  std::filesystem::path path, part;
  Handle file;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::system_error(std::make_error_code(std::errc::io_error), path.string() + what);
  }
  void require(bool succeeded, const std::string& array) const {
    if (!succeeded) fail(": array '" + array + "'");
  }

  void create(const std::string& name, const std::string& unit, const SeriesShape& shape, hid_t type) const {
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), extents(shape).data(), nullptr), H5Sclose);
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_create_intermediate_group(links, 1) >= 0 && make_plain(properties), name);
    const Handle dataset(H5Dcreate2(file, name.c_str(), type, space, links, properties, H5P_DEFAULT), H5Dclose);
    require(dataset.is_open() && write_unit(dataset, unit), name);
  }

  template <class T>
  void add(const std::string& name, const std::string& unit, SeriesShape shape, hid_t stored, hid_t native,
           std::span<const T> values) const {
    if (shape.empty()) shape = {values.size()};
    if (std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>()) != values.size()) {
      throw std::logic_error("the shape of series '" + name + "' does not fit its values");
    }
    create(name, unit, shape, stored);
    const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    require(dataset.is_open() && H5Dwrite(dataset, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, name);
  }
};

bool SeriesFile::available() { return true; }

SeriesFile::SeriesFile(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // it would print what an exception says
  impl_ = std::make_unique<Impl>(path);
}

SeriesFile::~SeriesFile() {
  if (!impl_->file.close()) return;
  std::error_code ignored;  // a destructor has nobody to tell
  std::filesystem::remove(impl_->part, ignored);
}

void SeriesFile::add(const std::string& name, const std::string& unit, std::span<const double> values,
                     SeriesShape shape) {
  impl_->add(name, unit, std::move(shape), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values);
}

void SeriesFile::add(const std::string& name, const std::string& unit, std::span<const std::int64_t> values,
                     SeriesShape shape) {
  impl_->add(name, unit, std::move(shape), H5T_STD_I64LE, H5T_NATIVE_INT64, values);
}

void SeriesFile::declare(const std::string& name, const std::string& unit, const SeriesShape& shape) {
  impl_->create(name, unit, shape, H5T_IEEE_F64LE);
}

void SeriesFile::write_rows(const std::string& name, std::uint64_t first, std::span<const double> values) {
  const Handle dataset(H5Dopen2(impl_->file, name.c_str(), H5P_DEFAULT), H5Dclose);
  impl_->require(dataset.is_open(), name);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<hsize_t> count(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, count.data(), nullptr);
  const hsize_t row = std::accumulate(count.begin() + 1, count.end(), hsize_t{1}, std::multiplies<>());
  const hsize_t size = values.size();
  impl_->require(row > 0 && size % row == 0, name);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = first;
  count[0] = size / row;
  const Handle memory(H5Screate_simple(1, &size, nullptr), H5Sclose);
  impl_->require(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
                     H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) >= 0,
                 name);
}

void SeriesFile::close() {
  const bool written = H5Fflush(impl_->file, H5F_SCOPE_LOCAL) >= 0;
  const bool closed = impl_->file.close();
  if (!written || !closed) impl_->fail("");
  std::filesystem::rename(impl_->part, impl_->path);
}

}  // namespace noli
