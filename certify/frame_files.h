// SPDX-License-Identifier: Apache-2.0
//
// Frames as numbered files of one pattern, "frames/cloth_%05d.ply", for export and repair.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli {

using FrameWriter = std::function<void(const Frame& frame, const std::filesystem::path& path)>;

/// A name with a number in it: the text before and after, and the width.
struct FramePattern {
  std::string before, after;
  std::size_t width = 0;

  std::filesystem::path file(std::uint64_t i) const;
  std::filesystem::path folder() const { return file(0).parent_path(); }
  /// The number in the name of a file of the folder, if the file matches the pattern.
  std::optional<std::uint64_t> number(const std::filesystem::path& path) const;
  /// See FrameFiles::beside().
  std::filesystem::path beside(const std::string& what) const;
};

/// Throws UsageError for a name without one %d or %0Nd.
FramePattern parse_pattern(const std::string& text);

/// The writer of a format, by the ending of the pattern: .ply, .obj, .vtu. Throws UsageError.
FrameWriter frame_writer_of(const std::string& pattern);

/// The files that a command writes its frames to. Those of a .vtu pattern get a series for ParaView beside them.
class FrameFiles {
 public:
  enum class Existing : std::uint8_t {
    refused,
    replaced,  ///< or removed by finish()
  };

  /// Makes the folder. Throws UsageError: no pattern, a place that cannot be written to; existing files of the pattern
  /// if they are refused.
  FrameFiles(const std::string& pattern, Existing existing);

  /// The first frames are there already, with these times. Precondition: none has been written.
  void go_on(std::vector<double> times) { times_ = std::move(times); }

  /// Writes the next frame, into a new file: what had its name, a link perhaps, is removed. Throws std::system_error.
  void add(double time, const Frame& frame, const FrameWriter& write);
  /// The next frame has the bytes of this file. Throws std::system_error.
  void add_copy(double time, const std::filesystem::path& file);
  /// Writes the series, and removes what an earlier call left of this pattern.
  void finish();

  std::uint64_t count() const { return times_.size(); }
  std::filesystem::path file(std::uint64_t i) const { return pattern_.file(i); }
  std::filesystem::path folder() const { return pattern_.folder(); }
  /// Whether a file that is there is one of these, by its name or by where that leads.
  bool may_be(const std::filesystem::path& file) const;
  /// The ending of the names: ".ply".
  std::string ending() const { return file(0).extension().string(); }
  const std::vector<double>& times() const { return times_; }
  std::uint64_t removed() const { return removed_; }  ///< by finish()
  /// A file beside the frames, named like them without the number: "cloth_times.csv" of "cloth_%03d.ply".
  std::filesystem::path beside(const std::string& what) const { return pattern_.beside(what); }
  /// Where the series of a .vtu pattern is, or would be.
  std::filesystem::path series_path() const;
  const std::string& series() const { return series_; }  ///< the file for ParaView that finish() wrote; empty: none

 private:
  std::filesystem::path free_name() const;
  void find_earlier(const std::string& pattern, Existing existing);
  bool has_series() const { return pattern_.after.ends_with(".vtu"); }

  FramePattern pattern_;
  std::vector<std::filesystem::path> earlier_;
  std::vector<double> times_;
  std::uint64_t removed_ = 0;
  std::string series_;
};

}  // namespace noli
