// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/series_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <noli/errors.h>

namespace noli {
namespace {

void require(bool holds, const std::string& name, const char* problem) {
  if (!holds) throw std::logic_error("series '" + name + "': " + problem);
}

void put_values(std::string& bytes, std::span<const double> values) { put_all(bytes, values); }
void put_values(std::string& bytes, std::span<const std::int64_t> values) {
  for (const std::int64_t value : values) put(bytes, static_cast<std::uint64_t>(value));
}

/// Whether one of the names is a group that contains the other.
bool one_is_in(const std::string& a, const std::string& b) { return a.starts_with(b + "/") || b.starts_with(a + "/"); }

/// The number of values of the piece that begins at `first`: whole rows, or the rest of one row up to a limit.
std::uint64_t piece_at(const SeriesShape& shape, std::uint64_t first) {
  constexpr std::uint64_t most = series::most_in_a_piece;
  const std::uint64_t row = series::product_from(shape, 1), inner = series::product_from(shape, 2);
  if (row <= most) return most / row * row;
  return std::min(most / inner * inner, row - first % row);
}

std::string advice(const std::filesystem::path& path, const std::string& why) {
  return fmt::format(
      "{}: not written: {}; the windows are all there: make room on the disk of {} if it is full, and pass --resume to "
      "write it again",
      path.string(), why, path.has_parent_path() ? path.parent_path().string() : ".");
}

/// Removes a part file that a killed process left, and returns the path.
const std::filesystem::path& without_part(const std::filesystem::path& path) {
  const std::filesystem::path part = path.string() + ".part";
  struct stat there = {};
  const bool is_there = ::lstat(part.c_str(), &there) == 0;
  if (is_there && !S_ISREG(there.st_mode)) {
    throw InputError(part.string(), "",
                     "is a link, or not a file; remove it, and pass --resume to write " + path.filename().string());
  }
  if ((!is_there || ::unlink(part.c_str()) != 0) && errno != ENOENT) {
    throw std::system_error(errno, std::generic_category(), part.string());
  }
  return path;
}

}  // namespace

SeriesFile::SeriesFile(const std::filesystem::path& path, const SeriesProgram& program)
    : path_(path), part_(without_part(path), {.name = ScratchName::part}), process_(program, part_.descriptor()) {
  std::string bytes;
  series::put_beginning(bytes);
  guarded([&] { process_.write(bytes); });
}

template <class F>
void SeriesFile::guarded(const F& work) {
  try {
    work();
  } catch (const SeriesLost& lost) {
    throw WriteError(advice(path_, lost.what()));
  } catch (const std::system_error& error) {
    throw WriteError(advice(path_, error.what()));
  }
}

void SeriesFile::declare(const series::Array& array) {
  require(!arrays_.contains(array.name), array.name, "the name is not new");
  for (const auto& [name, there] : arrays_)
    require(!one_is_in(name, array.name), array.name, "an array is not a group");
  require(!array.shape.empty() && array.shape.size() <= series::most_dimensions, array.name, "its dimensions");
  require(series::product_from(array.shape, 2) <= series::most_in_a_piece, array.name, "too much in one second index");
  std::string bytes;
  series::put_array(bytes, array);
  guarded([&] { process_.write(bytes); });
  arrays_.emplace(array.name, Declared{arrays_.size(), array.shape});
}

/// Precondition: `values` are whole rows of the array.
template <class T>
void SeriesFile::write(const Declared& array, std::uint64_t first, std::span<const T> values) {
  while (!values.empty()) {
    const auto piece = values.first(std::min<std::uint64_t>(values.size(), piece_at(array.shape, first)));
    std::string bytes;
    series::put_values(bytes, array.number, first, piece.size());
    put_values(bytes, piece);
    guarded([&] { process_.write(bytes); });
    first += piece.size();
    values = values.subspan(piece.size());
  }
}

template <class T>
void SeriesFile::add(series::Type type, const std::string& name, const std::string& unit, std::span<const T> values,
                     SeriesShape shape) {
  if (shape.empty()) shape = {values.size()};
  require(series::product_from(shape, 0) == values.size(), name, "the shape does not fit its values");
  declare(series::Array{type, name, unit, std::move(shape)});
  write(arrays_.at(name), 0, values);
}

void SeriesFile::add(const std::string& name, const std::string& unit, std::span<const double> values,
                     SeriesShape shape) {
  add(series::Type::f64, name, unit, values, std::move(shape));
}

void SeriesFile::add(const std::string& name, const std::string& unit, std::span<const std::int64_t> values,
                     SeriesShape shape) {
  add(series::Type::i64, name, unit, values, std::move(shape));
}

void SeriesFile::declare(const std::string& name, const std::string& unit, const SeriesShape& shape) {
  declare(series::Array{series::Type::f64, name, unit, shape});
}

void SeriesFile::write_rows(const std::string& name, std::uint64_t first, std::span<const double> values) {
  const auto found = arrays_.find(name);
  require(found != arrays_.end(), name, "no such array");
  const SeriesShape& shape = found->second.shape;
  const std::uint64_t row = series::product_from(shape, 1);
  require(row > 0 && values.size() % row == 0, name, "expected whole rows");
  require(first <= shape[0] && values.size() / row <= shape[0] - first, name, "no such row");
  write(found->second, first * row, values);
}

void SeriesFile::close() {
  std::string bytes;
  series::put_end(bytes);
  guarded([&] {
    process_.write(bytes);
    process_.finish();
    part_.take_name();
  });
}

}  // namespace noli
