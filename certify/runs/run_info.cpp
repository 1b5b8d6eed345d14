// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_info.h"

#include <algorithm>

#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_manifest.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// Sums over the windows.
struct Totals {
  std::uint64_t breakpoints = 0, most_breakpoints = 0, frames = 0;
  double end_time = 0;

  void add(const RunWindow& window) {
    breakpoints += window.breakpoints;
    most_breakpoints = std::max(most_breakpoints, window.breakpoints);
    frames += window.frames.size();
    end_time = window.end;
  }
};

Json versions_of(const std::filesystem::path& folder) {
  Json json = Json::object();
  for (const auto& [program, version] : read_manifest(folder).versions) json[program] = version;
  return json;
}

}  // namespace

Json run_info(const std::filesystem::path& folder) {
  const LogFacts log = read_log(folder);
  SeriesReader reader = open_run(folder, log);
  Totals totals;
  while (const auto window = reader.next_window()) {
    end_if_stopped();
    totals.add(*window);
  }
  require_series(folder, log);
  const RunHeader& header = reader.header();
  const Mesh& mesh = reader.mesh();
  return {{"file", folder.string()},
          {"format", "Noli run"},
          {"versions", versions_of(folder)},
          {"dimension", header.dimension},
          {"record", header.record == RecordMode::full ? "full" : "frames"},
          {"vertices", mesh.vertex_count},
          {"faces", mesh.faces.size()},
          {"loose_edges", mesh.edges.size()},
          {"loose_points", mesh.points.size()},
          {"window", header.window_length},
          {"windows", reader.windows()},
          {"end_time", totals.end_time},
          {"breakpoints", totals.breakpoints},
          {"most_breakpoints_in_a_window", totals.most_breakpoints},
          {"frames", totals.frames},
          {"open_window", reader.open_window().has_value()},
          {"bytes", std::filesystem::file_size(trajectory_path(folder))}};
}

}  // namespace noli
