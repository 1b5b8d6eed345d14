// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "trajectory/blocks/run_checks.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_payload.h"

namespace noli {
namespace {

constexpr const char* file_name = "trajectory.blocks";

/// The arguments come from this program, so a fault in them is a fault of the program, not of an input.
void require(bool holds, const std::string& problem) {
  if (!holds) throw std::logic_error("what was to be written to a run: " + problem);
}

void require_none(const std::string& problem) { require(problem.empty(), problem); }

bool fits_dimension(std::uint32_t dimension, std::span<const Position> vectors) {
  const auto good = [dimension](const Position& x) {
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]) &&
           (dimension == 3 || std::bit_cast<std::uint64_t>(x[2]) == 0);
  };
  return std::all_of(vectors.begin(), vectors.end(), good);
}

void check_cells(const Mesh& mesh) {
  const auto in_range = [&](VertexId v) { return v < mesh.vertex_count; };
  const auto within = [&](const auto& cell) { return std::ranges::all_of(cell, in_range); };
  require(std::ranges::all_of(mesh.faces, within), "a face beyond the mesh");
  require(std::ranges::all_of(mesh.edges, within), "an edge beyond the mesh");
  require(std::ranges::all_of(mesh.points, in_range), "a point beyond the mesh");
}

void check_scene(const RunScene& scene) {
  const RunHeader& header = scene.header;
  require(header.dimension == 2 || header.dimension == 3, "the dimension is neither 2 nor 3");
  require(std::isfinite(header.window_length) && header.window_length > 0, "the window length is not positive");
  require(scene.mesh.vertex_count > 0 && scene.labels.size() == scene.mesh.vertex_count,
          "not one label for each vertex");
  require(std::all_of(scene.labels.begin(), scene.labels.end(), [](auto label) { return label <= scripted_vertex; }),
          "a label that is not known");
  check_cells(scene.mesh);
  const Exclusions& exclusions = scene.exclusions;
  require(exclusions.groups.size() == (exclusions.empty() ? 0 : scene.mesh.vertex_count),
          "not one group for each vertex");
  require(exclusions.empty() || cells_of_one_group(scene.mesh, exclusions.groups), "a cell of two groups");
}

}  // namespace

std::filesystem::path trajectory_path(const std::filesystem::path& run_folder) { return run_folder / file_name; }

void put_lines_block(std::uint32_t dimension, const WorldLines& lines, const ByteConsumer& consumer) {
  const auto payload = [&](const ByteConsumer& take) { run_block::encode_lines(dimension, lines, take); };
  put_block(run_kind::lines, run_block::encoded_lines_size(dimension, lines), payload, consumer);
}

Sha256Digest lines_hash(std::uint32_t dimension, const WorldLines& lines) {
  Sha256 hash;
  put_lines_block(dimension, lines, [&hash](std::string_view bytes) { hash.update(bytes); });
  return hash.digest();
}

RunWriter::RunWriter(const std::filesystem::path& folder, const RunScene& scene)
    : RunWriter(std::make_unique<FileSink>(trajectory_path(folder), FileSink::Open::create), scene) {}

RunWriter::RunWriter(std::unique_ptr<Sink> sink, const RunScene& scene)
    : blocks_((check_scene(scene), std::move(sink)), run_kind::content),
      header_(scene.header),
      vertex_count_(scene.mesh.vertex_count) {
  blocks_.append(run_kind::head, run_block::encode_head(scene.header));
  blocks_.append(run_kind::mesh, run_block::encode_mesh(scene.mesh));
  blocks_.append(run_kind::labels, run_block::encode_labels(scene.labels));
  if (!scene.exclusions.empty()) {
    blocks_.append(run_kind::exclusions, run_block::encode_exclusions(scene.exclusions));
  }
  blocks_.commit();
}

RunWriter::RunWriter(const std::filesystem::path& folder, const RunReader& reader)
    : RunWriter(std::make_unique<FileSink>(trajectory_path(folder), FileSink::Open::existing), reader) {}

RunWriter::RunWriter(std::unique_ptr<Sink> sink, const RunReader& reader)
    : blocks_(std::move(sink), reader.blocks_.committed()),
      header_(reader.header()),
      vertex_count_(reader.mesh().vertex_count),
      last_(reader.last_) {}

void RunWriter::check(const WindowToWrite& window) const {
  require(!open_, "a window, though the one before is neither committed nor taken back");
  require(window.index == windows(), fmt::format("window {} where {} is due", window.index + 1, windows() + 1));
  require(window.lines.vertex_count() == vertex_count_ && window.velocities.size() == vertex_count_,
          "not a world line and a velocity for each vertex");
  require(fits_dimension(header_.dimension, window.velocities), "a velocity is not finite or leaves the plane");
  for (VertexId v = 0; v < vertex_count_; ++v) {
    require(fits_dimension(header_.dimension, window.lines.positions(v)), "a position leaves the plane");
  }
  require(header_.record == RecordMode::frames || window.frames.empty(), "frames in a full record");
  for (const RunFrame& frame : window.frames) {
    require(frame.positions.size() == vertex_count_ && fits_dimension(header_.dimension, frame.positions),
            "a frame without a finite position for each vertex");
  }
}

void RunWriter::append_frames(const WindowToWrite& window, const WindowEnd& end) {
  const Sha256Digest hash = lines_hash(header_.dimension, window.lines);
  blocks_.append(run_kind::lines_hash, run_block::encode_lines_hash(count_breakpoints(window.lines), hash));
  for (const RunFrame& frame : window.frames) {
    blocks_.append(run_kind::frame, run_block::encode_frame(header_.dimension, frame));
  }
  blocks_.append(run_kind::ends, run_block::encode_vectors(header_.dimension, end.positions));
}

void RunWriter::append_window(const WindowToWrite& window) {
  check(window);
  const double begin = window.lines.first_time();
  WindowEnd end{window.lines.last_time(), positions_at_end(window.lines)};
  if (last_) {
    require_none(time_problem(*last_, begin));
    require_none(position_problem(*last_, window.lines));
  }
  require_none(frames_problem(window.index, begin, end, window.frames));
  blocks_.append(run_kind::window, run_block::encode_window(window.index, begin, end.time));
  if (header_.record == RecordMode::full) {
    const auto payload = [&](const ByteConsumer& take) {
      run_block::encode_lines(header_.dimension, window.lines, take);
    };
    blocks_.append(run_kind::lines, run_block::encoded_lines_size(header_.dimension, window.lines), payload);
  } else {
    append_frames(window, end);
  }
  blocks_.append(run_kind::velocities, run_block::encode_vectors(header_.dimension, window.velocities));
  blocks_.append(run_kind::state, window.state);
  open_ = std::move(end);
}

void RunWriter::commit() {
  require(open_.has_value(), "a commit of nothing");
  blocks_.commit();
  last_ = std::move(open_);
  open_.reset();
}

void RunWriter::discard_window() {
  blocks_.discard();
  open_.reset();
}

}  // namespace noli
