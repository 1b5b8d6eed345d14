// SPDX-License-Identifier: Apache-2.0
//
// Reads arrays of numbers from an HDF5 file that may be hostile.
//
// Only what is in the file itself is read: no external or virtual data, no links to other files, no filters but those
// built into the library. Sizes are compared with the file's own extents before anything is allocated.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace noli::series {

/// The file is not as it must be. what() says where: "VTKHDF/Points: ...".
struct BadInput : std::runtime_error {
  BadInput(const std::string& where, const std::string& message) : std::runtime_error(where + ": " + message) {}
};

/// An array of a file. Closed by the destructor.
class Hdf5Array {
 public:
  enum class Type : std::uint8_t { f32, f64, integer };

  Hdf5Array(hid_t dataset, std::string name);
  ~Hdf5Array();
  Hdf5Array(const Hdf5Array&) = delete;
  Hdf5Array& operator=(const Hdf5Array&) = delete;

  const std::string& name() const { return name_; }
  Type type() const { return type_; }
  const std::vector<std::uint64_t>& shape() const { return shape_; }
  /// How many numbers a row has, which is everything with one first index.
  std::uint64_t row() const;

  /// Throws BadInput unless there are so many rows from `first` on.
  void require_rows(std::uint64_t first, std::uint64_t count) const;

  /// Rows [first, first + count), as numbers of this type in memory: float for f32, double for f64, int64_t for
  /// integers (those beyond its range become its ends). Throws BadInput. `to` has room for them.
  void read(std::uint64_t first, std::uint64_t count, void* to) const;
  /// The same of integers. Throws BadInput also for other types, and for more numbers than a mesh can need.
  std::vector<std::int64_t> integers(std::uint64_t first, std::uint64_t count) const;

 private:
  hid_t dataset_;
  std::string name_;
  Type type_ = Type::integer;
  std::vector<std::uint64_t> shape_;
};

class Hdf5Input {
 public:
  /// Precondition: the descriptor is a regular file, open for reading. Throws BadInput if it is not HDF5.
  explicit Hdf5Input(int descriptor);

  /// Whether there is a group or an array of this name: "VTKHDF/Points". Throws BadInput for links to it.
  bool has(const std::string& path) const;
  /// Throws BadInput if the array is missing, has an unsupported type, or has numbers in other files.
  Hdf5Array array(const std::string& path) const;

  /// An attribute of a group. Throws BadInput.
  std::string text(const std::string& group, const std::string& attribute) const;
  std::vector<std::int64_t> integers(const std::string& group, const std::string& attribute) const;

 private:
  hid_t file_;
};

}  // namespace noli::series
