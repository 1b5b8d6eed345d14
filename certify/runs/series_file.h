// SPDX-License-Identifier: Apache-2.0
//
// `series.h5`: named arrays of numbers as plain HDF5, without filters or chunks, so that any reader of HDF5 reads it:
//   h5py.File("series.h5")["energy/kinetic"][:], and its attribute "unit"
//
// The program noli_series (certify/series) makes the file; it gets the arrays through a pipe. noli itself does not link
// HDF5.
//
// It cannot append to an existing file. Its bytes are not promised to be the same on every machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "certify/runs/series_process.h"
#include "certify/series/stream.h"
#include "trajectory/replaced_file.h"

namespace noli {

/// Number of entries along each dimension, the one that varies slowest first.
using SeriesShape = series::Shape;

/// A new file, written as "PATH.part" and renamed when it is closed. All functions throw WriteError, naming the file
/// and what to do, when it cannot be written; SeriesStopped; std::logic_error when a precondition does not hold. After
/// an error nothing may follow.
class SeriesFile {
 public:
  /// First removes a part file that a killed process left. Throws InputError when that name is a link or a folder;
  /// std::system_error, naming the file, when it cannot be created.
  explicit SeriesFile(const std::filesystem::path& path, const SeriesProgram& program);

  /// Adds an array; a name "energy/kinetic" is an array in a group. `unit` is SI, "1" for a pure number. Without a
  /// shape it has one dimension. Preconditions: the name is new, and is not the name of a group, nor its group the name
  /// of an array; the shape fits the number of values.
  void add(const std::string& name, const std::string& unit, std::span<const double> values, SeriesShape shape = {});
  void add(const std::string& name, const std::string& unit, std::span<const std::int64_t> values,
           SeriesShape shape = {});

  /// Adds an array of doubles that is written in pieces, for arrays that do not fit into memory. Row i is everything
  /// with first index i. write_rows() writes row `first` and those after it, as many as there are values.
  /// Preconditions: the shape has at least one dimension; the values are whole rows of the array.
  void declare(const std::string& name, const std::string& unit, const SeriesShape& shape);
  void write_rows(const std::string& name, std::uint64_t first, std::span<const double> values);

  /// Finishes the file and gives it its name. Nothing may follow.
  void close();

 private:
  struct Declared {
    std::uint64_t number;
    SeriesShape shape;
  };

  template <class F>
  void guarded(const F& work);
  void declare(const series::Array& array);
  template <class T>
  void add(series::Type type, const std::string& name, const std::string& unit, std::span<const T> values,
           SeriesShape shape);
  template <class T>
  void write(const Declared& array, std::uint64_t first, std::span<const T> values);

  std::filesystem::path path_;
  ReplacedFile part_;
  SeriesProcess process_;
  std::map<std::string, Declared> arrays_;
};

}  // namespace noli
