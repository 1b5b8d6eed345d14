// SPDX-License-Identifier: Apache-2.0
//
// Frames of one mesh as files, taken two at a time.
//
// Notation
//   frame k    the k-th file, k = 0 .. n - 1; the mesh is that of frame 0, and all others must have the same
//   step k     Motion::linear: from frame k to frame k + 1, n - 1 steps
//              Motion::constant: frame k stands still, n steps
//
// What this does not do: it reads nothing ahead and keeps nothing behind, so at most the positions of two frames and
// the file of one are in memory.
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

/// Reads a frame; the extension says how (mesh_format). Throws InputError, also for other extensions.
Frame read_frame(const std::filesystem::path& path);

/// The same for the bytes of a file; `path` says how to read them and is what errors call them.
/// `polygons`: what to do with those, and where they are noted.
Frame parse_frame(std::string_view bytes, const std::filesystem::path& path, Polygons* polygons = nullptr);

/// Throws InputError when the meshes differ in vertex count or in any cell; the message names both files and the first
/// difference.
void require_same_mesh(const Mesh& expected, const std::filesystem::path& expected_path, const Mesh& found,
                       const std::filesystem::path& found_path);

/// Whether all z are equal (as numbers): then nothing leaves a plane z = const, which may be another one in the next
/// frame, and the step may be decided in two dimensions. True for no positions.
bool all_z_equal(std::span<const Position> positions);

enum class Motion {
  linear,   ///< between successive frames each vertex moves at constant velocity
  constant  ///< each frame is a moment of its own
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
  /// require_same_mesh do; the sequence must not be used any more then.
  bool next();

  /// Number of the current step, from 0. This and all below: precondition: next() returned true.
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

/// ".ply": in lower case.
std::string extension_of(const std::filesystem::path& path);

enum class MeshFormat { ply, obj };

/// Whether a file of this name is a frame, by its extension.
bool is_frame_name(const std::filesystem::path& path);

/// By the extension, in any case. Throws InputError for all but .ply and .obj, with conversion_advice().
MeshFormat mesh_format(const std::filesystem::path& path);

/// How to make frames of a file by its extension (.npz .npy .abc .usd .stl .vtk .vtu .gz .glb .fbx and others), one
/// line; "" for extensions that are not known.
std::string conversion_advice(const std::filesystem::path& path);

}  // namespace noli
