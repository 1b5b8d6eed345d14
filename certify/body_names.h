// SPDX-License-Identifier: Apache-2.0
//
// Names vertices and features by their bodies: "vertex cloth[7] meets edge floor[0]-floor[1]".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <noli/frames.h>
#include <noli/mesh.h>
#include <noli/query.h>
#include "certify/json.h"

namespace noli {

class BodyNames {
 public:
  /// A body's vertices are first, ..., first + vertices - 1.
  struct Body {
    std::string name;
    std::uint64_t first = 0, vertices = 0;
    std::optional<std::uint64_t> first_face = {};  ///< of a body whose files count faces from 0
  };

  /// No bodies: vertices are named by their numbers.
  explicit BodyNames(std::vector<Body> bodies = {}) : bodies_(std::move(bodies)) {}

  /// The inverse of to_json(); no bodies for any other JSON.
  static BodyNames from_json(const Json& json);
  Json to_json() const;

  /// Whether there are any bodies.
  bool known() const { return !bodies_.empty(); }
  const std::vector<Body>& bodies() const { return bodies_; }
  /// The body that has a vertex; nullptr for a vertex without a body.
  const Body* body_of(VertexId v) const;
  /// The bodies that have any of these vertices, in the order of bodies; vertices without a body are ignored.
  std::vector<std::string> bodies_of(std::span<const VertexId> vertices) const;
  /// A vertex by its body and its number there.
  std::string vertex(VertexId v) const;
  /// "vertex a[0]", "edge a[0]-a[1]" or the like. Precondition: one to three vertices.
  std::string feature(std::span<const VertexId> vertices) const;
  /// "face a[17]" if the body counts its faces, else "cell 17 (a)"; "cell 17" without bodies. The mesh has to have it.
  std::string cell(const Mesh& mesh, std::uint32_t cell) const;
  /// Both features of a pair, with a word between them. `vertices`: those of the first feature come first.
  std::string pair(FeaturePair kind, std::span<const VertexId> vertices, const std::string& between) const;

 private:
  std::vector<Body> bodies_;
};

/// The names for the bodies of frames.
BodyNames names_of_frames(const std::vector<FrameBody>& bodies);

/// The names for the bodies of a built scene: anything with name, first and vertices.
template <class Bodies>
BodyNames names_of(const Bodies& built) {
  std::vector<BodyNames::Body> bodies;
  bodies.reserve(built.size());
  for (const auto& body : built) bodies.push_back({body.name, body.first, body.vertices, std::nullopt});
  return BodyNames(std::move(bodies));
}

}  // namespace noli
