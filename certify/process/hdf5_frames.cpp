// SPDX-License-Identifier: Apache-2.0
#include "certify/process/hdf5_frames.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include <noli/errors.h>
#include "certify/process/child.h"
#include "certify/runs/series_process.h"
#include "trajectory/formats/arrays/converted_frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr std::string_view note_word = "note: ";

/// The program at work on a file. Its output is what was asked for.
class Reading {
 public:
  Reading(const std::filesystem::path& program, const char* what, std::filesystem::path file, PolygonRule rule)
      : file_(std::move(file)) {
    std::error_code error;
    if (std::filesystem::exists(file_, error) && !std::filesystem::is_regular_file(file_, error)) {
      throw InputError(file_.string(), "", "is not a regular file; expected one, as HDF5 needs random access");
    }
    input_.take(::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (input_.get() < 0)
      throw InputError(file_.string(), "", fmt::format("cannot be opened: {}", std::strerror(errno)));
    child_.emplace(std::vector<std::string>{program.string(), what, rule == PolygonRule::refuse ? "refuse" : "fan"},
                   Child::Descriptors{.in = input_.get(), .out = Child::piped, .err = Child::piped});
  }

  /// The next bytes, at most `size`; 0 at the end. Throws InputError for what the program says of the file.
  std::size_t read(char* to, std::size_t size) {
    for (Patience patience(longest_silence); child_ && child_->out.empty() && !child_->silent();) {
      end_if_stopped();
      if (patience.is_over())
        throw HelperError(fmt::format("noli_series did not respond in time on {}", file_.string()));
      child_->look(std::chrono::milliseconds(100));
    }
    if (!child_) return 0;
    if (child_->out.empty()) {
      finish();
      return 0;
    }
    const std::size_t got = std::min(size, child_->out.size());
    std::copy_n(child_->out.begin(), got, to);
    child_->out.erase(0, got);
    return got;
  }

  std::vector<std::string> notes() const { return notes_; }

 private:
  static constexpr std::chrono::minutes longest_silence{5};

  void finish() {
    const ProgramEnd end = child_->finish({.stop = [] { return stop_asked().has_value(); }, .to_end = {}});
    child_.reset();
    if (end.kind == ProgramEnd::Kind::stopped) end_if_stopped();
    if (end.kind == ProgramEnd::Kind::signalled && end.code == SIGXCPU) {
      throw InputError(file_.string(), "", "HDF5 took too long to read it; it is damaged, or has too many parts");
    }
    if (end.exited_with(3)) throw InputError(file_.string(), "", first_line(end.err));
    if (!end.exited_with(0)) {
      const bool said = end.kind == ProgramEnd::Kind::exited && !end.err.empty();
      throw HelperError(
          fmt::format("noli_series failed on {}: {}", file_.string(), said ? first_line(end.err) : end.words()));
    }
    std::istringstream lines(end.err);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(note_word)) notes_.push_back(line.substr(note_word.size()));
    }
  }

  std::filesystem::path file_;
  Descriptor input_;
  std::optional<Child> child_;
  std::vector<std::string> notes_;
};

class SeriesBytes : public ConvertedBytes {
 public:
  SeriesBytes(const std::filesystem::path& program, const std::filesystem::path& file, PolygonRule rule)
      : reading_(program, "frames", file, rule) {}
  std::size_t read(char* to, std::size_t size) override { return reading_.read(to, size); }
  std::vector<std::string> notes() const override { return reading_.notes(); }

 private:
  Reading reading_;
};

class SeriesConverter : public FrameConverter {
 public:
  explicit SeriesConverter(std::filesystem::path program) : program_(std::move(program)) {}

  Look look(const std::filesystem::path& file, PolygonRule rule) const override {
    Reading reading(program_, "look", file, rule);
    std::string line(1000, '\0');
    std::size_t size = 0;
    while (const std::size_t got = reading.read(line.data() + size, line.size() - size)) size += got;
    std::istringstream words(line.substr(0, size));
    Look look;
    words >> look.frames >> look.vertices >> look.cells >> look.numbers >> look.polygons >> look.mesh;
    if (!words)
      throw HelperError(fmt::format("noli_series said about {}: {}", file.string(), first_line(line.substr(0, size))));
    return look;
  }

  std::unique_ptr<ConvertedBytes> open(const std::filesystem::path& file, PolygonRule rule) const override {
    return std::make_unique<SeriesBytes>(program_, file, rule);
  }

 private:
  std::filesystem::path program_;
};

}  // namespace

std::unique_ptr<FrameSource> open_all_frames(const std::vector<std::filesystem::path>& names, FrameReading reading) {
  const SeriesProgram program = series_program();
  if (program.available()) reading.hdf5 = std::make_shared<const SeriesConverter>(program.file);
  return open_frames(names, reading);
}

}  // namespace noli
