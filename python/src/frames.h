// SPDX-License-Identifier: Apache-2.0
//
// Frames and meshes as python/noli/_frames.py hands them over.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>

#include <noli/frames.h>
#include "certify/process/scratch_folder.h"
#include "python/src/background.h"

namespace noli::python {

/// The frames of a noli._frames.Given, which this keeps. Calls of Python are made through `background`, if that is set:
/// it has to be while frames are read. Arrays are read without any.
class Frames {
 public:
  explicit Frames(pybind11::object given);

  const std::shared_ptr<const GivenFrames>& given() const { return given_; }
  /// Frames are read now. The background outlives that.
  void call_through(Background* background) { *background_ = background; }
  /// Frames are read once more. Throws UsageError if a generator made them.
  void read_again_through(Background* background);

 private:
  std::shared_ptr<Background*> background_;
  std::shared_ptr<const GivenFrames> given_;
};

/// The mesh of a noli._mesh.CollisionMesh. Precondition: its vertex_count is known.
Mesh mesh_of(const pybind11::object& mesh, std::size_t vertex_count);

/// Bodies whose vertices and faces are consecutive, if all are; nothing otherwise.
std::vector<FrameBody> bodies_of(const pybind11::object& mesh, std::size_t vertex_count);

/// The file of groups (certify/groups.h) that leaves out what the mesh ignores; nothing if it ignores nothing. `named`:
/// frames have the bodies of bodies_of(), which then are the groups.
struct IgnoredGroups {
  ScratchFolder folder;
  std::filesystem::path file;
};
std::shared_ptr<const IgnoredGroups> ignored_groups_of(const pybind11::object& mesh, std::size_t vertex_count,
                                                       bool named);

}  // namespace noli::python
