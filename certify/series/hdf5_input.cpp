// SPDX-License-Identifier: Apache-2.0
#include "certify/series/hdf5_input.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "certify/series/descriptor_driver.h"
#include "certify/series/ending.h"

namespace noli::series {
namespace {

/// A handle of HDF5 and the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t operator*() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Checks a return value of HDF5, a handle or a status.
template <class Said>
Said require(Said said, const std::string& where, const std::string& message) {
  if (said < 0) throw BadInput(where, message);
  return said;
}

Hdf5Array::Type type_of(hid_t dataset, const std::string& name) {
  const Handle type(require(H5Dget_type(dataset), name, "its type cannot be read"), H5Tclose);
  if (H5Tget_class(*type) == H5T_INTEGER && H5Tget_size(*type) <= 8) return Hdf5Array::Type::integer;
  if (H5Tequal(*type, H5T_IEEE_F32LE) > 0 || H5Tequal(*type, H5T_IEEE_F32BE) > 0) return Hdf5Array::Type::f32;
  if (H5Tequal(*type, H5T_IEEE_F64LE) > 0 || H5Tequal(*type, H5T_IEEE_F64BE) > 0) return Hdf5Array::Type::f64;
  throw BadInput(name, "expected integers, float32 or float64");
}

std::vector<std::uint64_t> shape_of(hid_t dataset, const std::string& name) {
  const Handle space(require(H5Dget_space(dataset), name, "its shape cannot be read"), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(*space);
  if (rank < 1 || rank > 3) throw BadInput(name, "expected one to three dimensions");
  std::array<hsize_t, 3> lengths{};
  require(H5Sget_simple_extent_dims(*space, lengths.data(), nullptr), name, "its shape cannot be read");
  return {lengths.begin(), lengths.begin() + rank};
}

/// As for members of .npz files.
constexpr double most_unpacked = 1e9, most_ratio = 200;

bool is_allocated(hid_t dataset) {
  H5D_space_status_t status = H5D_SPACE_STATUS_ERROR;
  return H5Dget_space_status(dataset, &status) >= 0 && status == H5D_SPACE_STATUS_ALLOCATED;
}

/// By their number: what the library says of their bytes counts packed chunks as parts.
bool has_all_chunks(hid_t dataset, hid_t made, hid_t space) {
  std::array<hsize_t, H5S_MAX_RANK> lengths{}, chunk{};
  const int rank = H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  if (rank < 1 || H5Pget_chunk(made, rank, chunk.data()) != rank) return false;
  hsize_t expected = 1, there = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
    const hsize_t along = chunk[i] == 0 ? 0 : lengths[i] / chunk[i] + (lengths[i] % chunk[i] != 0 ? 1 : 0);
    if (along == 0 || __builtin_mul_overflow(expected, along, &expected)) return false;
  }
  return H5Dget_num_chunks(dataset, space, &there) >= 0 && there == expected;
}

/// Throws unless all numbers are in the file itself: not in others, and not in chunks that were never written, which
/// the library reads as zeros.
void require_own_data(hid_t dataset, const std::string& name) {
  const Handle made(require(H5Dget_create_plist(dataset), name, "cannot be read"), H5Pclose);
  if (H5Pget_external_count(*made) != 0 || H5Pget_layout(*made) == H5D_VIRTUAL) {
    throw BadInput(name, "is in other files; expected numbers in this one");
  }
  const Handle space(require(H5Dget_space(dataset), name, "its shape cannot be read"), H5Sclose);
  const bool chunked = H5Pget_layout(*made) == H5D_CHUNKED;
  const bool whole = chunked ? has_all_chunks(dataset, *made, *space) : is_allocated(dataset);
  if (H5Sget_simple_extent_npoints(*space) > 0 && !whole) throw BadInput(name, "has numbers that were never written");
  const Handle type(require(H5Dget_type(dataset), name, "its type cannot be read"), H5Tclose);
  const auto unpacked =
      static_cast<double>(H5Sget_simple_extent_npoints(*space)) * static_cast<double>(H5Tget_size(*type));
  if (unpacked > most_unpacked && unpacked > most_ratio * static_cast<double>(H5Dget_storage_size(dataset))) {
    throw BadInput(name, "is longer than 1 GB and was packed to less than 1/200");
  }
}

/// Whether there is an object of this name. Throws BadInput unless hard links lead to it, which stay in the file: what
/// is there under another kind of link must not count as missing.
bool is_there(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/');; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (require(H5Lexists(file, part.c_str(), H5P_DEFAULT), part, "cannot be looked up") == 0) return false;
    H5L_info_t link;
    require(H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT), part, "cannot be looked up");
    if (link.type != H5L_TYPE_HARD) throw BadInput(part, "is a soft or external link; expected the object itself");
    if (end == std::string::npos) return true;
  }
}

/// Other letters as question marks: messages repeat the text.
std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

struct Attribute {
  std::string name;
  Handle id, type, space;

  Attribute(hid_t file, const std::string& group, const std::string& attribute)
      : name(group + "." + attribute),
        id(require(H5Aopen_by_name(file, group.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), name,
                   "is not there"),
           H5Aclose),
        type(require(H5Aget_type(*id), name, "cannot be read"), H5Tclose),
        space(require(H5Aget_space(*id), name, "cannot be read"), H5Sclose) {}

  void read(hid_t as, void* to) const { require(H5Aread(*id, as, to), name, "cannot be read"); }
};

constexpr std::uint64_t most_integers = std::uint64_t{1} << 28;  // at once

}  // namespace

Hdf5Array::Hdf5Array(hid_t dataset, std::string name) : dataset_(dataset), name_(std::move(name)) {
  try {
    require_own_data(dataset_, name_);
    type_ = type_of(dataset_, name_);
    shape_ = shape_of(dataset_, name_);
  } catch (...) {
    H5Dclose(dataset_);
    throw;
  }
}

Hdf5Array::~Hdf5Array() { H5Dclose(dataset_); }

std::uint64_t Hdf5Array::row() const {
  std::uint64_t product = 1;
  for (std::size_t i = 1; i < shape_.size(); ++i) {
    if (__builtin_mul_overflow(product, shape_[i], &product)) throw BadInput(name_, "has too many numbers");
  }
  return product;
}

void Hdf5Array::require_rows(std::uint64_t first, std::uint64_t count) const {
  if (first <= shape_[0] && count <= shape_[0] - first) return;
  throw BadInput(name_, "has " + std::to_string(shape_[0]) + " rows; expected " + std::to_string(count) + " from row " +
                            std::to_string(first) + " on");
}

void Hdf5Array::read(std::uint64_t first, std::uint64_t count, void* to) const {
  require_rows(first, count);
  if (count == 0 || row() == 0) return;
  const Handle space(require(H5Dget_space(dataset_), name_, "its shape cannot be read"), H5Sclose);
  std::array<hsize_t, 3> start{first, 0, 0}, size{count, 1, 1};
  for (std::size_t i = 1; i < shape_.size(); ++i) size[i] = shape_[i];
  require(H5Sselect_hyperslab(*space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), name_,
          "cannot be read");
  const Handle memory(
      require(H5Screate_simple(static_cast<int>(shape_.size()), size.data(), nullptr), name_, "cannot be read"),
      H5Sclose);
  const hid_t type = type_ == Type::f32 ? H5T_NATIVE_FLOAT : type_ == Type::f64 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
  require(H5Dread(dataset_, type, *memory, *space, H5P_DEFAULT, to), name_,
          "cannot be read: it is damaged, or packed by a filter that is not built into HDF5");
}

std::vector<std::int64_t> Hdf5Array::integers(std::uint64_t first, std::uint64_t count) const {
  if (type_ != Type::integer) throw BadInput(name_, "expected integers");
  require_rows(first, count);
  if (row() > most_integers || count > most_integers / std::max<std::uint64_t>(row(), 1)) {
    throw BadInput(name_, "has more integers than a mesh can need");
  }
  std::vector<std::int64_t> values(static_cast<std::size_t>(count * row()));
  read(first, count, values.data());
  return values;
}

Hdf5Input::Hdf5Input(int descriptor) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  if (access < 0 || H5PLset_loading_state(0) < 0 || !use_descriptor(access, descriptor, end_lost))
    end_with(Ending::failure, "HDF5 fails");
  file_ = require(H5Fopen("frames", H5F_ACC_RDONLY, access), "the file",
                  "is not HDF5, or damaged; expected what ParaView, VTK or Noli write");
}

bool Hdf5Input::has(const std::string& path) const { return is_there(file_, path); }

Hdf5Array Hdf5Input::array(const std::string& path) const {
  if (!has(path)) throw BadInput(path, "is not there; expected an array");
  return {require(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), path, "expected an array"), path};
}

std::string Hdf5Input::text(const std::string& group, const std::string& attribute) const {
  const Attribute text(file_, group, attribute);
  constexpr std::size_t most_letters = 256;
  if (H5Tget_class(*text.type) != H5T_STRING || H5Sget_simple_extent_npoints(*text.space) != 1) {
    throw BadInput(text.name, "expected a string");
  }
  if (H5Tis_variable_str(*text.type) > 0) {
    char* letters = nullptr;
    text.read(*text.type, static_cast<void*>(&letters));
    std::string result = letters == nullptr ? "" : std::string(letters, ::strnlen(letters, most_letters));
    H5free_memory(letters);
    return printable(result);
  }
  const std::size_t size = H5Tget_size(*text.type);
  if (size > most_letters) throw BadInput(text.name, "is too long");
  std::string result(size, '\0');
  text.read(*text.type, result.data());
  return printable(result.substr(0, result.find('\0')));
}

std::vector<std::int64_t> Hdf5Input::integers(const std::string& group, const std::string& attribute) const {
  const Attribute numbers(file_, group, attribute);
  const hssize_t count = H5Sget_simple_extent_npoints(*numbers.space);
  if (H5Tget_class(*numbers.type) != H5T_INTEGER || count < 1 || count > 16) {
    throw BadInput(numbers.name, "expected integers");
  }
  std::vector<std::int64_t> result(static_cast<std::size_t>(count));
  numbers.read(H5T_NATIVE_INT64, result.data());
  return result;
}

}  // namespace noli::series
