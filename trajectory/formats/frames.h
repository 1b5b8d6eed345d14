// SPDX-License-Identifier: Apache-2.0
//
// Reads the frames of one mesh from files, two at a time.
//
// Notation
//   frame k    the k-th file, k = 0 .. n - 1; all frames must have the mesh of frame 0
//   step k     Motion::linear: from frame k to frame k + 1, n - 1 steps
//              Motion::constant: frame k stands still, n steps
//
// It does not read ahead, so at most the positions of two frames and the file of one are in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// Reads a frame; the extension decides how (mesh_format). Throws InputError, also for other extensions.
Frame read_frame(const std::filesystem::path& path);

/// The same for the bytes of a file; `path` decides how to read them, and errors name it. `polygons`: the rule for
/// polygons, which are also listed there.
Frame parse_frame(std::string_view bytes, const std::filesystem::path& path, Polygons* polygons = nullptr);

/// Throws InputError when the meshes differ in vertex count or in any cell; the message names both files and the first
/// difference.
void require_same_mesh(const Mesh& expected, const std::filesystem::path& expected_path, const Mesh& found,
                       const std::filesystem::path& found_path);

/// Whether all z are equal (as numbers). If so in both frames of a step, even with different z, the step may be decided
/// in two dimensions. True for no positions.
bool all_z_equal(std::span<const Position> positions);

enum class Motion {
  linear,   ///< between successive frames each vertex moves at constant velocity
  constant  ///< each frame by itself, at rest
};

/// How a sequence reads frame k; read_frame() for example.
using ReadFrame = std::function<Frame(const std::filesystem::path& path, std::size_t k)>;

/// The steps of a sequence, in order:
///   FrameSequence sequence(paths);
///   while (sequence.next()) use(sequence.mesh(), sequence.x_t0(), sequence.x_t1());
class FrameSequence {
 public:
  /// Throws InputError when there are fewer frames than a step needs (two, or one with Motion::constant). Reads nothing
  /// yet.
  explicit FrameSequence(std::vector<std::filesystem::path> paths, Motion motion = Motion::linear, ReadFrame read = {});

  std::size_t frame_count() const { return paths_.size(); }
  std::size_t step_count() const { return motion_ == Motion::linear ? paths_.size() - 1 : paths_.size(); }

  /// Reads what the next step needs and moves to it; false when there is none. Throws InputError as read_frame and
  /// require_same_mesh do; after that the sequence must not be used.
  bool next();

  /// Number of the current step, from 0. Precondition of this and all below: next() returned true.
  std::size_t step() const { return frames_read_ - (motion_ == Motion::linear ? 2 : 1); }
  const Mesh& mesh() const { return mesh_; }
  std::span<const Position> x_t0() const { return motion_ == Motion::linear ? x_t0_ : x_t1_; }
  std::span<const Position> x_t1() const { return x_t1_; }
  const std::filesystem::path& path_t0() const { return paths_[step()]; }
  const std::filesystem::path& path_t1() const { return paths_[frames_read_ - 1]; }

 private:
  void read_next_frame();

  std::vector<std::filesystem::path> paths_;
  Motion motion_;
  ReadFrame read_;
  std::size_t frames_read_ = 0;
  Mesh mesh_;
  std::vector<Position> x_t0_, x_t1_;
};

/// The extension in lower case, such as ".ply".
std::string extension_of(const std::filesystem::path& path);

enum class MeshFormat { ply, obj };

/// The format, by the extension in upper or lower case. Throws InputError with conversion_advice() for all extensions
/// except .ply and .obj.
MeshFormat mesh_format(const std::filesystem::path& path);

/// How to convert a file to frames, by its extension (.npz .npy .abc .usd .stl .vtk .vtu .gz .glb .fbx and others); one
/// line, or "" for an unknown extension.
std::string conversion_advice(const std::filesystem::path& path);

}  // namespace noli
