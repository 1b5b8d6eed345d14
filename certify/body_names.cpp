// SPDX-License-Identifier: Apache-2.0
#include "certify/body_names.h"

#include <fmt/format.h>

#include <algorithm>

#include <noli/errors.h>
#include "trajectory/cell_features.h"

namespace noli {
namespace {

bool is_body(const Json& json) {
  return json.is_object() && json.contains("name") && json["name"].is_string() && json.contains("first") &&
         json["first"].is_number_unsigned() && json.contains("vertices") && json["vertices"].is_number_unsigned();
}

}  // namespace

BodyNames BodyNames::from_json(const Json& json) {
  std::vector<Body> bodies;
  if (!json.is_array()) return BodyNames();
  for (const Json& body : json) {
    if (!is_body(body)) return BodyNames();
    bodies.push_back({body["name"], body["first"], body["vertices"], std::nullopt});
  }
  return BodyNames(std::move(bodies));
}

Json BodyNames::to_json() const {
  Json json = Json::array();
  for (const Body& body : bodies_) {
    json.push_back({{"name", body.name}, {"first", body.first}, {"vertices", body.vertices}});
  }
  return json;
}

std::vector<std::string> BodyNames::bodies_of(std::span<const VertexId> vertices) const {
  std::vector<VertexId> sorted(vertices.begin(), vertices.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::string> names;
  for (const Body& body : bodies_) {
    const auto least = std::lower_bound(sorted.begin(), sorted.end(), body.first);
    if (least != sorted.end() && *least - body.first < body.vertices) names.push_back(body.name);
  }
  return names;
}

const BodyNames::Body* BodyNames::body_of(VertexId v) const {
  for (const Body& body : bodies_) {
    if (v >= body.first && v - body.first < body.vertices) return &body;
  }
  return nullptr;
}

std::string BodyNames::vertex(VertexId v) const {
  const Body* const body = body_of(v);
  return body != nullptr ? fmt::format("{}[{}]", body->name, v - body->first) : fmt::format("{}", v);
}

BodyNames names_of_frames(const std::vector<FrameBody>& bodies) {
  std::vector<BodyNames::Body> names;
  for (const FrameBody& body : bodies) names.push_back({body.name, body.first_vertex, body.vertices, body.first_face});
  return BodyNames(std::move(names));
}

std::string BodyNames::feature(std::span<const VertexId> vertices) const {
  static constexpr const char* names[] = {"vertex", "edge", "face"};
  std::string text = names[vertices.size() - 1];
  for (std::size_t i = 0; i < vertices.size(); ++i) text += (i == 0 ? " " : "-") + vertex(vertices[i]);
  return text;
}

std::string BodyNames::cell(const Mesh& mesh, std::uint32_t cell) const {
  const Body* const body = body_of(corners(mesh, cell)[0]);
  if (body == nullptr) return fmt::format("cell {}", cell);
  const std::string name = on_one_line(body->name);
  if (body->first_face && cell < mesh.faces.size()) return fmt::format("face {}[{}]", name, cell - *body->first_face);
  return fmt::format("cell {} ({})", cell, name);
}

std::string BodyNames::pair(FeaturePair kind, std::span<const VertexId> vertices, const std::string& between) const {
  const std::size_t first = first_size(kind), size = point_count(kind);
  return feature(vertices.first(first)) + " " + between + " " + feature(vertices.subspan(first, size - first));
}

}  // namespace noli
