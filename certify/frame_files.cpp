// SPDX-License-Identifier: Apache-2.0
#include "certify/frame_files.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include <noli/errors.h>
#include "certify/result_file.h"
#include "trajectory/formats/vtk/write_vtu.h"
#include "trajectory/formats/write_obj.h"
#include "trajectory/formats/write_ply.h"

namespace noli {
namespace {

[[noreturn]] void refuse(const std::string& pattern) {
  throw UsageError("-o " + pattern + ": expected a name with one %d or %05d that ends in .ply, .obj or .vtu");
}

}  // namespace

FramePattern parse_pattern(const std::string& text) {
  const std::size_t percent = text.find('%'), d = text.find('d', percent);
  if (percent == std::string::npos || d == std::string::npos || text.find('%', percent + 1) != std::string::npos) {
    refuse(text);
  }
  const std::string width = text.substr(percent + 1, d - percent - 1);
  const bool digits = width.size() <= 3 && width.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || (!width.empty() && width[0] != '0') || text.find('/', d) != std::string::npos) refuse(text);
  return {text.substr(0, percent), text.substr(d + 1), width.empty() ? 0 : std::stoul(width)};
}

std::filesystem::path FramePattern::file(std::uint64_t i) const {
  return fmt::format("{}{:0{}}{}", before, i, width, after);
}

std::optional<std::uint64_t> FramePattern::number(const std::filesystem::path& path) const {
  const std::string name = path.filename().string();
  const std::size_t begin = std::filesystem::path(before).filename().string().size();
  if (name.size() <= begin + after.size()) return std::nullopt;
  std::uint64_t i = 0;
  const char* const end = name.data() + name.size() - after.size();
  const auto [rest, error] = std::from_chars(name.data() + begin, end, i);
  if (error != std::errc() || rest != end || file(i).filename() != name) return std::nullopt;
  return i;
}

std::filesystem::path FramePattern::beside(const std::string& what) const {
  std::string stem = std::filesystem::path(before).filename().string();
  while (!stem.empty() && (stem.back() == '_' || stem.back() == '-' || stem.back() == '.')) stem.pop_back();
  return folder() / (stem + (stem.empty() || what.empty() ? "" : "_") + what);
}

FrameWriter frame_writer_of(const std::string& pattern) {
  const std::string ending = std::filesystem::path(pattern).extension().string();
  if (ending == ".ply") {
    return [](const Frame& frame, const auto& path) { write_ply(path, frame, PlyEncoding::binary_little_endian); };
  }
  if (ending == ".obj") return [](const Frame& frame, const auto& path) { write_obj(path, frame); };
  if (ending == ".vtu") return [](const Frame& frame, const auto& path) { write_vtu(path, frame); };
  refuse(pattern);
}

FrameFiles::FrameFiles(const std::string& pattern, Existing existing) : pattern_(parse_pattern(pattern)) {
  find_earlier(pattern, existing);
  make_writable_folder(pattern_.folder(), "-o");
}

bool FrameFiles::may_be(const std::filesystem::path& file) const {
  const std::filesystem::path mine = folder().empty() ? "." : folder();
  std::error_code error;
  const auto is_here = [&](const std::filesystem::path& path) {
    if (!pattern_.number(folder() / path.filename())) return false;
    const std::filesystem::path parent = path.parent_path().empty() ? "." : path.parent_path();
    return std::filesystem::equivalent(parent, mine, error);
  };
  return is_here(file) || is_here(std::filesystem::canonical(file, error));
}

void FrameFiles::find_earlier(const std::string& pattern, Existing existing) {
  const std::filesystem::path folder = pattern_.folder();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::filesystem::path path = folder / entry.path().filename();
    const bool series = has_series() && path == series_path();
    if (!series && !pattern_.number(path)) continue;
    if (entry.is_directory(error)) throw UsageError("-o " + path.string() + ": is a folder; expected a file");
    if (!series) earlier_.push_back(path);
    if (existing == Existing::replaced) continue;
    throw UsageError("-o " + pattern + ": " + path.string() + " exists already; choose another name, or pass --force");
  }
}

std::filesystem::path FrameFiles::free_name() const {
  const std::filesystem::path name = file(count());
  std::filesystem::remove(name);
  return name;
}

void FrameFiles::add(double time, const Frame& frame, const FrameWriter& write) {
  write(frame, free_name());
  times_.push_back(time);
}

void FrameFiles::add_copy(double time, const std::filesystem::path& file) {
  const std::filesystem::path name = free_name();
  std::filesystem::copy_file(file, name);
  std::filesystem::permissions(name, std::filesystem::perms::owner_write, std::filesystem::perm_options::add);
  times_.push_back(time);
}

void FrameFiles::finish() {
  if (has_series()) {
    std::vector<PvdEntry> entries;
    for (std::uint64_t i = 0; i < count(); ++i) entries.push_back({times_[i], file(i).filename().string()});
    write_pvd(series_path(), entries);
    series_ = series_path().string();
  }
  for (const auto& path : earlier_) {
    if (pattern_.number(path) >= count()) removed_ += std::filesystem::remove(path) ? 1 : 0;
  }
}

std::filesystem::path FrameFiles::series_path() const {
  const std::filesystem::path plain = beside("");
  return plain.filename().empty() ? folder() / "series.pvd" : std::filesystem::path(plain.string() + ".pvd");
}

}  // namespace noli
