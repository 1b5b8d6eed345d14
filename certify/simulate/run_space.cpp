// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/run_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Bytes, measured on the scenes that come with the program. For each window besides its motion: its state, its commit,
/// a line of the log. For its proof: step and commit, and 20 (in 2D) to 125 bytes for each cell.
constexpr double window_overhead = 900, proof_overhead = 200, proof_of_cell = 110;
/// Bytes of series.h5: a row for each window, and the file without rows.
constexpr double series_row_size = 450, series_file_size = 25e3;

/// The folder, or its nearest parent that exists.
fs::path there_or_above(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  while (!fs::exists(folder, error) && folder != folder.parent_path()) folder = folder.parent_path();
  return folder;
}

double bytes_a_window(const integrator::Scene& scene, const integrator::Explanation& explanation,
                      const RunToCome& run) {
  const double motion = explanation.bytes * scene.window + window_overhead;
  if (scene.record == integrator::Record::frames || !run.prove) return motion;
  return motion + proof_of_cell * static_cast<double>(run.cells) + proof_overhead;
}

/// Whether the run is resumed; its size is then predicted from what it has written so far.
bool goes_on(const RunToCome& run) { return run.windows_there > 0 && run.time_there > 0; }

double motion_to_come(const integrator::Scene& scene, const integrator::Explanation& explanation,
                      const RunToCome& run) {
  if (!goes_on(run)) return static_cast<double>(run.windows) * bytes_a_window(scene, explanation, run);
  return static_cast<double>(run.bytes_there) * std::max(0.0, run.time - run.time_there) / run.time_there;
}

double windows_in_all(const RunToCome& run) {
  if (!goes_on(run)) return static_cast<double>(run.windows);
  return static_cast<double>(run.windows_there) * std::max(1.0, run.time / run.time_there);
}

std::string what_is_written(const RunBytes& bytes) {
  std::string what = !bytes.full ? "frames" : bytes.proved ? "world lines, proof" : "world lines";
  if (bytes.full && bytes.series > 0) what += " and frames";
  return what;
}

std::string about(const RunBytes& bytes) {
  return fmt::format("{}about {} of {}", bytes.at_least ? "at least " : "", bytes_text(bytes.all()),
                     what_is_written(bytes));
}

}  // namespace

RunBytes bytes_to_come(const integrator::Scene& scene, const integrator::Explanation& explanation,
                       const RunToCome& run) {
  RunBytes bytes;
  bytes.full = scene.record == integrator::Record::full;
  bytes.proved = bytes.full && run.prove;
  bytes.at_least = !explanation.contact.empty() && !goes_on(run);
  bytes.motion = motion_to_come(scene, explanation, run);
  if (!run.series) return bytes;
  const double frames = run.time * scene.frame_rate + 1;  // the whole file is written anew
  bytes.series = frames * (24.0 * static_cast<double>(run.vertices) + 8) + windows_in_all(run) * series_row_size +
                 series_file_size;
  return bytes;
}

std::optional<std::uint64_t> free_bytes(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(there_or_above(folder), error);
  if (error || space.available == static_cast<std::uintmax_t>(-1)) return std::nullopt;
  return space.available;
}

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t sum = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::uint64_t size = entry.is_regular_file(error) ? entry.file_size(error) : 0;
    if (!error) sum += size;
  }
  return sum;
}

std::string space_note(const RunBytes& bytes, const fs::path& run, std::optional<std::uint64_t> free) {
  std::string note = fmt::format("{} in {}", about(bytes), run.string());
  if (free) note += fmt::format("; {} are free", bytes_text(static_cast<double>(*free)));
  return note;
}

std::optional<std::string> space_problem(const RunBytes& bytes, const fs::path& run,
                                         std::optional<std::uint64_t> free) {
  if (!free || bytes.all() <= static_cast<double>(*free)) return std::nullopt;
  return fmt::format(
      "-o {}: the disk has {} left, but the run needs {}; free space, {}shorten the run with --until, or pass "
      "--ignore-space, as this is a prediction",
      run.string(), bytes_text(static_cast<double>(*free)), about(bytes),
      bytes.full ? "record only frames (\"record\": \"frames\" in the scene), " : "");
}

std::string bytes_text(double bytes) {
  static constexpr std::array<const char*, 7> units = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  if (bytes >= 999.5) return fmt::format("{:.2g} {}", bytes, units[unit]);
  return unit > 0 && bytes < 9.95 ? fmt::format("{:.1f} {}", bytes, units[unit])
                                  : fmt::format("{:.0f} {}", bytes, units[unit]);
}

}  // namespace noli
