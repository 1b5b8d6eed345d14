// SPDX-License-Identifier: Apache-2.0
//
// In place of series_file.cpp in a build without HDF5.
#include <system_error>

#include "noli/trajectory/series_file.h"

namespace noli {
namespace {

[[noreturn]] void refuse(const std::string& file) {
  throw std::system_error(
      std::make_error_code(std::errc::not_supported),
      file + ": this Noli was built without HDF5 (CMake option NOLI_WITH_HDF5, Debian package libhdf5-dev)");
}

}  // namespace

struct SeriesFile::Impl {};

bool SeriesFile::available() { return false; }

SeriesFile::SeriesFile(const std::filesystem::path& path) { refuse(path.string()); }
SeriesFile::~SeriesFile() = default;

// None of these can be reached: there is no object.
void SeriesFile::add(const std::string& name, const std::string&, std::span<const double>, SeriesShape) {
  refuse(name);
}
void SeriesFile::add(const std::string& name, const std::string&, std::span<const std::int64_t>, SeriesShape) {
  refuse(name);
}
void SeriesFile::declare(const std::string& name, const std::string&, const SeriesShape&) { refuse(name); }
void SeriesFile::write_rows(const std::string& name, std::uint64_t, std::span<const double>) { refuse(name); }
void SeriesFile::close() { refuse("series"); }

}  // namespace noli
