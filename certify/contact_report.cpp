// SPDX-License-Identifier: Apache-2.0
#include "certify/contact_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

namespace noli {
namespace {

using Ids = std::vector<VertexId>;

/// Vertex ids of the two features of a contact.
std::pair<Ids, Ids> features(const FeatureContact& contact) {
  const auto begin = contact.vertices.begin();
  const auto middle = begin + static_cast<std::ptrdiff_t>(first_size(contact.pair));
  const auto end = begin + static_cast<std::ptrdiff_t>(point_count(contact.pair));
  return {Ids(begin, middle), Ids(middle, end)};
}

std::string feature_text(const Ids& ids) {
  static constexpr const char* names[] = {"vertex", "edge", "face"};
  return fmt::format("{} {}", names[ids.size() - 1], fmt::join(ids, "-"));
}

}  // namespace

Json contact_json(const FeatureContact& contact) {
  const auto [first, second] = features(contact);
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
          {"activations", counts.activations},
          {"deactivations", counts.deactivations},
          {"most_near", counts.most_near},
          {"deepest", counts.deepest}};
}

Json contact_json(const integrator::ContactSettings& settings) {
  const integrator::LayerSchedule& s = settings.schedule;
  Json materials = Json::array();
  for (const auto& m : settings.materials) {
    materials.push_back({{"thickness", m.thickness},
                         {"stiffness", m.stiffness},
                         {"step", m.step},
                         {"restitution", m.restitution},
                         {"friction", m.friction}});
  }
  return {{"most_layers", settings.most_layers},
          {"layers", {s.thickness_quarters, s.stiffness_quarters, s.step_quarters}},
          {"materials", materials}};
}

std::string contact_text(const FeatureContact& contact) {
  const auto [first, second] = features(contact);
  return fmt::format("{} meets {}", feature_text(first), feature_text(second));
}

std::string pair_in_short(const FeatureContact& contact, std::optional<std::uint32_t> face) {
  const auto [first, second] = features(contact);
  const bool numbered = face && contact.pair == FeaturePair::vertex_face;
  return fmt::format("{} × {}", feature_text(first), numbered ? fmt::format("face {}", *face) : feature_text(second));
}

}  // namespace noli
