// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "trajectory/error.h"
#include "trajectory/formats/frame_formats.h"
#include "trajectory/formats/obj.h"
#include "trajectory/formats/ply.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// Throws when two lists of cells differ, naming the first that does.
template <class Cell>
void require_same_cells(std::string_view what, const std::vector<Cell>& expected, const std::string& expected_name,
                        const std::vector<Cell>& found, const std::string& found_name) {
  if (found.size() != expected.size()) {
    throw InputError(found_name, "",
                     fmt::format("has {} {}s, but {} has {}; all frames must have the same mesh", found.size(), what,
                                 expected_name, expected.size()));
  }
  const auto [theirs, ours] = std::mismatch(found.begin(), found.end(), expected.begin());
  if (theirs == found.end()) return;
  throw InputError(found_name, "",
                   fmt::format("{} {} has vertices {}, but {} has {} there; all frames must have the same mesh", what,
                               theirs - found.begin(), *theirs, expected_name, *ours));
}

}  // namespace

Frame read_frame(const std::filesystem::path& path) {
  mesh_format(path);  // before the file is opened
  return parse_frame(read_whole_file(path), path);
}

Frame parse_frame(std::string_view bytes, const std::filesystem::path& path, Polygons* polygons) {
  const bool ply = mesh_format(path) == MeshFormat::ply;
  return ply ? parse_ply(bytes, path.string(), polygons) : parse_obj(bytes, path.string(), polygons);
}

void require_same_mesh(const Mesh& expected, const std::filesystem::path& expected_path, const Mesh& found,
                       const std::filesystem::path& found_path) {
  const std::string expected_name = expected_path.string(), found_name = found_path.string();
  if (found.vertex_count != expected.vertex_count) {
    throw InputError(found_name, "",
                     fmt::format("has {} vertices, but {} has {}; all frames must have the same mesh",
                                 found.vertex_count, expected_name, expected.vertex_count));
  }
  require_same_cells("face", expected.faces, expected_name, found.faces, found_name);
  require_same_cells("loose edge", expected.edges, expected_name, found.edges, found_name);
  require_same_cells("loose point", expected.points, expected_name, found.points, found_name);
}

bool all_z_equal(std::span<const Position> positions) {
  return std::all_of(positions.begin(), positions.end(), [&](const Position& x) { return x[2] == positions[0][2]; });
}

FrameSequence::FrameSequence(std::vector<std::filesystem::path> paths, Motion motion, ReadFrame read)
    : paths_(std::move(paths)), motion_(motion), read_(std::move(read)) {
  if (paths_.empty()) throw InputError("frames", "", "there are none");
  if (motion_ == Motion::linear && paths_.size() == 1) {
    throw InputError(paths_[0].string(), "", "is a single frame, expected at least two to have a motion");
  }
}

bool FrameSequence::next() {
  if (frames_read_ == paths_.size()) return false;
  if (frames_read_ == 0 && motion_ == Motion::linear) read_next_frame();
  read_next_frame();
  return true;
}

void FrameSequence::read_next_frame() {
  x_t0_ = std::exchange(x_t1_, {});
  if (motion_ == Motion::constant) x_t0_ = {};
  const std::filesystem::path& path = paths_[frames_read_];
  Frame frame = read_ ? read_(path, frames_read_) : read_frame(path);
  if (frames_read_ == 0) {
    mesh_ = std::move(frame.mesh);
  } else {
    require_same_mesh(mesh_, paths_[0], frame.mesh, path);
  }
  x_t1_ = std::move(frame.positions);
  ++frames_read_;
}

}  // namespace noli
