// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_info.h"

#include <algorithm>

#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_manifest.h"
#include "trajectory/stop.h"

namespace noli {

Json run_info(const std::filesystem::path& folder) {
  const LogFacts log = read_log(folder);
  SeriesReader reader = open_run(folder, log);
  std::uint64_t breakpoints = 0, most_breakpoints = 0, frames = 0;
  double end_time = 0;
  while (const auto window = reader.next_window()) {
    end_if_stopped();
    breakpoints += window->breakpoints;
    most_breakpoints = std::max(most_breakpoints, window->breakpoints);
    frames += window->frames.size();
    end_time = window->end;
  }
  require_series(folder, log);
  const RunHeader& header = reader.header();
  const Mesh& mesh = reader.mesh();
  return {{"file", folder.string()},
          {"format", "Noli run"},
          {"versions", read_manifest(folder).versions},
          {"dimension", header.dimension},
          {"record", header.record == RecordMode::full ? "full" : "frames"},
          {"vertices", mesh.vertex_count},
          {"faces", mesh.faces.size()},
          {"loose_edges", mesh.edges.size()},
          {"loose_points", mesh.points.size()},
          {"window", header.window_length},
          {"windows", reader.windows()},
          {"end_time", end_time},
          {"breakpoints", breakpoints},
          {"most_breakpoints_in_a_window", most_breakpoints},
          {"frames", frames},
          {"open_window", reader.open_window().has_value()},
          {"bytes", std::filesystem::file_size(trajectory_path(folder))}};
}

}  // namespace noli
