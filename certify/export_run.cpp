// SPDX-License-Identifier: Apache-2.0
#include <noli/export.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include <noli/errors.h>
#include "certify/export_frames.h"
#include "certify/result_file.h"
#include "certify/runs/frame_times.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/vtk/write_vtu.h"
#include "trajectory/formats/write_obj.h"
#include "trajectory/formats/write_ply.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// A pattern such as "frames/%05d.ply": the text before and after the number, and its width.
struct Pattern {
  std::string before, after;
  std::size_t width = 0;

  std::filesystem::path file(std::uint64_t i) const { return fmt::format("{}{:0{}}{}", before, i, width, after); }
  std::filesystem::path folder() const { return file(0).parent_path(); }

  /// The number in the name of a file of the folder, if the file matches the pattern.
  std::optional<std::uint64_t> number(const std::filesystem::path& path) const {
    const std::string name = path.filename().string();
    const std::size_t begin = std::filesystem::path(before).filename().string().size();
    if (name.size() <= begin + after.size()) return std::nullopt;
    std::uint64_t i = 0;
    const char* const end = name.data() + name.size() - after.size();
    const auto [rest, error] = std::from_chars(name.data() + begin, end, i);
    if (error != std::errc() || rest != end || file(i).filename() != name) return std::nullopt;
    return i;
  }
};

[[noreturn]] void refuse(const std::string& pattern) {
  throw UsageError("-o " + pattern + ": expected a name with one %d or %05d that ends in .ply, .obj, .vtu or .png");
}

FrameWriter writer_of(const std::string& pattern) {
  const std::string ending = std::filesystem::path(pattern).extension().string();
  if (ending == ".ply") {
    return [](const Frame& frame, const auto& path) { write_ply(path, frame, PlyEncoding::binary_little_endian); };
  }
  if (ending == ".obj") return [](const Frame& frame, const auto& path) { write_obj(path, frame); };
  if (ending == ".vtu") return [](const Frame& frame, const auto& path) { write_vtu(path, frame); };
  refuse(pattern);
}

Pattern parse_pattern(const std::string& text) {
  const std::size_t percent = text.find('%'), d = text.find('d', percent);
  if (percent == std::string::npos || d == std::string::npos || text.find('%', percent + 1) != std::string::npos) {
    refuse(text);
  }
  const std::string width = text.substr(percent + 1, d - percent - 1);
  const bool digits = width.size() <= 3 && width.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || (!width.empty() && width[0] != '0') || text.find('/', d) != std::string::npos) refuse(text);
  return {text.substr(0, percent), text.substr(d + 1), width.empty() ? 0 : std::stoul(width)};
}

class Export {
 public:
  Export(const ExportRequest& request, const FrameWriter& write)
      : request_(request), write_(write), pattern_(parse_pattern(request.pattern)), reader_(open_run(request.run)) {
    find_earlier();
    make_writable_folder(pattern_.folder(), "-o");
  }

  ExportOutcome operator()() {
    outcome_.recorded = reader_.header().record == RecordMode::frames;
    const auto windows = static_cast<double>(std::max<std::uint64_t>(reader_.look().windows, 1));
    while (auto window = reader_.next_window()) {
      write_frames(*window);
      if (is_interrupted()) break;
      ++outcome_.windows;
      if (request_.progress) request_.progress(std::min(1.0, static_cast<double>(outcome_.windows) / windows));
      outcome_.end = window->end;
    }
    if (outcome_.windows == 0 && !outcome_.interrupted) {
      throw InputError(request_.run.string(), "", "has no windows that are committed; there is nothing to export");
    }
    outcome_.open_window = !outcome_.interrupted && reader_.open_window().has_value();
    if (has_series()) write_series();
    remove_earlier();
    return std::move(outcome_);
  }

 private:
  /// Finds the files of earlier exports.
  void find_earlier() {
    const std::filesystem::path folder = pattern_.folder();
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
      const std::filesystem::path path = folder / entry.path().filename();
      const bool series = has_series() && path == pvd_path();
      if (!series && !pattern_.number(path)) continue;
      if (entry.is_directory(error)) throw UsageError("-o " + path.string() + ": is a folder; expected a file");
      if (!series) earlier_.push_back(path);
      if (request_.force) continue;
      throw UsageError("-o " + request_.pattern + ": " + path.string() +
                       " exists already; choose another name, or pass --force");
    }
  }

  void remove_earlier() {
    for (const auto& path : earlier_) {
      if (pattern_.number(path) >= outcome_.frames) outcome_.removed += std::filesystem::remove(path) ? 1 : 0;
    }
  }

  /// Whether there is a file for ParaView that names the frames.
  bool has_series() const { return pattern_.after.ends_with(".vtu"); }

  void write_frames(const RunWindow& window) {
    for_each_frame(window, request_.fps, [&](double t, const std::vector<Position>& positions) {
      if (is_interrupted()) return false;
      times_.push_back(t);
      write_({reader_.mesh(), positions}, pattern_.file(outcome_.frames++));
      return true;
    });
  }

  bool is_interrupted() {
    outcome_.interrupted = outcome_.interrupted || stop_asked().has_value();
    return outcome_.interrupted;
  }

  /// The file for ParaView: next to the frames, named like them without the number.
  std::filesystem::path pvd_path() const {
    std::string stem = std::filesystem::path(pattern_.before).filename().string();
    while (!stem.empty() && (stem.back() == '_' || stem.back() == '-' || stem.back() == '.')) stem.pop_back();
    return pattern_.folder() / ((stem.empty() ? "series" : stem) + ".pvd");
  }

  void write_series() {
    std::vector<PvdEntry> entries;
    for (std::uint64_t i = 0; i < outcome_.frames; ++i) {
      entries.push_back({times_[i], pattern_.file(i).filename().string()});
    }
    write_pvd(pvd_path(), entries);
    outcome_.pvd = pvd_path().string();
  }

  const ExportRequest& request_;
  const FrameWriter& write_;
  Pattern pattern_;
  SeriesReader reader_;
  std::vector<std::filesystem::path> earlier_;
  std::vector<double> times_;
  ExportOutcome outcome_;
};

}  // namespace

ExportOutcome export_frames(const ExportRequest& request, const FrameWriter& write) { return Export(request, write)(); }

ExportOutcome run_export(const ExportRequest& request) { return export_frames(request, writer_of(request.pattern)); }

}  // namespace noli
