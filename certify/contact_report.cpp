// SPDX-License-Identifier: Apache-2.0
#include "certify/contact_report.h"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "certify/body_names.h"

namespace noli {
namespace {

MeetingBodies meeting_bodies(const integrator::BuiltContact& contact) {
  std::set<std::array<std::uint64_t, 2>> all;  // those of two classes of a body count once
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

std::string pair_in_short(const FeatureContact& contact, std::optional<std::uint32_t> face) {
  const bool numbered = face && contact.pair == FeaturePair::vertex_face;
  if (numbered) return fmt::format("vertex {} × face {}", contact.vertices[0], *face);
  return BodyNames().pair(contact.pair, contact.vertices, "×");
}

}  // namespace noli
