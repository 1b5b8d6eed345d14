// SPDX-License-Identifier: Apache-2.0
#include "certify/contact_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <noli/errors.h>
#include "certify/body_names.h"

namespace noli {
namespace {

MeetingBodies meeting_bodies(const integrator::BuiltContact& contact) {
  std::set<std::array<std::uint64_t, 2>> all;  // pairs that differ only in the classes of a body count once
  for (const auto& pair : contact.pairs) all.insert({pair.bodies[0], pair.bodies[1]});
  MeetingBodies result;
  for (const auto& pair : all) {
    if (result.pairs.size() == MeetingBodies::most) break;
    result.pairs.push_back(pair);
  }
  result.more = all.size() - result.pairs.size();
  return result;
}

}  // namespace

Json contact_json(const FeatureContact& contact) {
  const auto begin = contact.vertices.begin(), middle = begin + first_size(contact.pair);
  const std::vector<VertexId> first(begin, middle), second(middle, begin + point_count(contact.pair));
  return {{"pair", name(contact.pair)}, {"features", Json::array({first, second})}};
}

Json contact_json(const ListedContact& listed) {
  Json json = contact_json(listed.contact);
  if (const auto face = face_of(listed)) json["face"] = *face;
  json["cells"] = listed.cells;
  if (!listed.bodies[0].empty() || !listed.bodies[1].empty()) json["bodies"] = listed.bodies;
  if (!listed.own[0].empty()) {
    json["own"] = {{"features", listed.own}};
    if (listed.own_face) json["own"]["face"] = *listed.own_face;
  }
  json["kind"] = name(listed.kind);
  json["step"] = listed.step;
  json["time"] = listed.time;
  json["point"] = listed.point;
  return json;
}

Json counts_json(const ContactCounts& counts) {
  Json json = Json::object();
  for (const FeaturePair pair : all_feature_pairs) {
    json[std::string(name(pair))] = counts[static_cast<std::size_t>(pair)];
  }
  return json;
}

Json certificates_json(const CertificateCounts& counts) {
  return {{"slices", counts.slices},
          {"tubes", counts.tubes},
          {"plans", counts.plans},
          {"penned", counts.penned},
          {"repairs", counts.repairs},
          {"events", counts.events},
          {"activations", counts.activations},
          {"deactivations", counts.deactivations},
          {"most_near", counts.most_near},
          {"deepest", counts.deepest}};
}

Json contact_json(const integrator::ContactSettings& settings, std::span<const integrator::BuiltContact> built) {
  const integrator::LayerSchedule& s = settings.schedule;
  Json materials = Json::array();
  for (const auto& m : settings.materials) {
    materials.push_back({{"thickness", m.thickness},
                         {"stiffness", m.stiffness},
                         {"step", m.step},
                         {"restitution", m.restitution},
                         {"friction", m.friction}});
  }
  for (std::size_t m = 0; built.size() > 1 && m < built.size(); ++m) {
    const MeetingBodies bodies = meeting_bodies(built[m]);
    materials[m]["pairs"] = bodies.pairs;
    materials[m]["more_pairs"] = bodies.more;
  }
  return {{"most_layers", settings.most_layers},
          {"inclusion_exclusion", settings.inclusion_exclusion},
          {"layers", {s.thickness_quarters, s.stiffness_quarters, s.step_quarters}},
          {"materials", materials}};
}

std::string contact_text(const FeatureContact& contact) {
  return BodyNames().pair(contact.pair, contact.vertices, "meets");
}

std::string pair_in_short(const FeatureContact& contact) {
  return BodyNames().pair(contact.pair, contact.vertices, "×");
}

/// "edge shirt[3]-shirt[4]", "face avatar[17]": as the body counts.
std::string own_name(const ListedContact& listed, std::size_t which) {
  const std::string body = on_one_line(listed.bodies[which]);
  if (which == 1 && listed.own_face) return fmt::format("face {}[{}]", body, *listed.own_face);
  static constexpr const char* kinds[] = {"vertex", "edge", "face"};
  std::string text;
  for (const VertexId v : listed.own[which]) text += fmt::format("{}{}[{}]", text.empty() ? "" : "-", body, v);
  return fmt::format("{} {}", kinds[listed.own[which].size() - 1], text);
}

std::string pair_in_short(const ListedContact& listed) {
  if (!listed.own[0].empty() && !listed.own[1].empty()) return own_name(listed, 0) + " × " + own_name(listed, 1);
  const FeatureContact& contact = listed.contact;
  const std::size_t first = first_size(contact.pair);
  const std::span<const VertexId> all(contact.vertices.data(), point_count(contact.pair));
  std::array<std::string, 2> names = {BodyNames().feature(all.first(first)), BodyNames().feature(all.subspan(first))};
  if (const auto face = face_of(listed)) names[1] = fmt::format("face {}", *face);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!listed.bodies[i].empty()) names[i] += fmt::format(" ({})", on_one_line(listed.bodies[i]));
  }
  return names[0] + " × " + names[1];
}

std::string who_and_where(const ListedContact& listed, int dimension) {
  std::string point;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    if (!std::isfinite(listed.point[d])) return pair_in_short(listed);
    point += (d == 0 ? "" : ", ") + digits4(listed.point[d]);
  }
  return fmt::format("{} at ({})", pair_in_short(listed), point);
}

std::optional<std::uint32_t> face_of(const ListedContact& listed) {
  if (listed.contact.pair != FeaturePair::vertex_face || listed.cells[1].empty()) return std::nullopt;
  return listed.cells[1].front();
}

}  // namespace noli
