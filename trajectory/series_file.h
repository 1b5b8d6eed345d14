// SPDX-License-Identifier: Apache-2.0
//
// `series.h5`: named arrays of numbers as plain HDF5, without filters or chunks, so that any reader of HDF5 reads it:
//   h5py.File("series.h5")["energy/kinetic"][:], and its attribute "unit"
//
// What this does not do: it appends to no file that is there, and what is promised byte for byte is not in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace noli {

/// Number of entries along each dimension, the one that varies slowest first.
using SeriesShape = std::vector<std::uint64_t>;

/// A new file. It is written beside its place ("PATH.part") and takes the name when it is closed. All functions throw
/// std::system_error, naming the file and the array, when it cannot be written.
class SeriesFile {
 public:
  /// Whether Noli was built with HDF5 (CMake option NOLI_WITH_HDF5). If not, the constructor throws std::system_error
  /// with std::errc::not_supported, and what is missing.
  static bool available();

  explicit SeriesFile(const std::filesystem::path& path);
  /// Leaves nothing behind of a file that was not closed.
  ~SeriesFile();
  SeriesFile(const SeriesFile&) = delete;
  SeriesFile& operator=(const SeriesFile&) = delete;

  /// Adds an array; a name "energy/kinetic" is an array in a group. `unit` is SI, "1" for a pure number. Without a
  /// shape it has one dimension. The name must be new. Throws std::logic_error when the shape does not fit the number
  /// of values.
  void add(const std::string& name, const std::string& unit, std::span<const double> values, SeriesShape shape = {});
  void add(const std::string& name, const std::string& unit, std::span<const std::int64_t> values,
           SeriesShape shape = {});

  /// Adds an array of doubles that is written in pieces, for what does not fit into memory: row i is all with first
  /// index i. write_rows() writes row `first` and those after it, as many as there are values for. Preconditions: the
  /// shape has at least one dimension; each row is written before close().
  void declare(const std::string& name, const std::string& unit, const SeriesShape& shape);
  void write_rows(const std::string& name, std::uint64_t first, std::span<const double> values);

  /// Finishes the file and gives it its name. Nothing may follow.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace noli
