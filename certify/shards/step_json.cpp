// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/step_json.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace noli {
namespace {

constexpr std::array<ContactKind, 3> contact_kinds = {ContactKind::touching, ContactKind::crossing,
                                                      ContactKind::persistent};

template <class Value>
Value named(const Json& json, const auto& all) {
  const auto text = json.get<std::string>();
  const auto found = std::ranges::find_if(all, [&](Value value) { return name(value) == text; });
  if (found == std::end(all)) throw std::invalid_argument("an unknown word: " + text);
  return *found;
}

/// A time of a step.
double time_of(const Json& json) {
  const auto time = json.get<double>();
  if (!(time >= 0 && time <= 1)) throw std::invalid_argument("a time that is not in [0, 1]");
  return time;
}

Json contact_as_json(const FeatureContact& contact) {
  return {name(contact.pair), contact.vertices, contact.first.begin, contact.first.end};
}

FeatureContact contact_of(const Json& json) {
  FeatureContact contact;
  contact.pair = named<FeaturePair>(json.at(0), all_feature_pairs);
  contact.vertices = json.at(1).get<std::array<VertexId, 4>>();
  contact.first = {time_of(json.at(2)), time_of(json.at(3))};
  return contact;
}

Json first_as_json(const FirstInStep& first) {
  return {{"contact", contact_as_json(first.contact)}, {"kind", name(first.kind)}, {"time", first.time}};
}

FirstInStep first_of(const Json& json) {
  return {contact_of(json.at("contact")), named<ContactKind>(json.at("kind"), contact_kinds), time_of(json.at("time"))};
}

}  // namespace

Json step_json(const StepResult& result) {
  Json reports = Json::array(), initial = Json::array();
  for (const FeatureContact& contact : result.reports) reports.push_back(contact_as_json(contact));
  for (const auto& [a, b] : result.initial_reports) initial.push_back({a, b});
  return {{"complete", result.complete},
          {"contacts", result.contacts},
          {"initial_intersections", result.initial_intersections},
          {"reports", reports},
          {"initial_reports", initial},
          {"stages", result.stages.decided},
          {"obligations", result.obligations},
          {"cell_pairs", result.cell_pairs},
          {"first", result.first ? first_as_json(*result.first) : Json()},
          {"goes_on", result.goes_on}};
}

StepResult step_of_json(const Json& json) {
  StepResult result;
  result.complete = json.at("complete").get<bool>();
  result.contacts = json.at("contacts").get<ContactCounts>();
  result.initial_intersections = json.at("initial_intersections").get<std::uint64_t>();
  for (const Json& contact : json.at("reports")) result.reports.push_back(contact_of(contact));
  for (const Json& pair : json.at("initial_reports")) {
    result.initial_reports.push_back({pair.at(0).get<std::uint32_t>(), pair.at(1).get<std::uint32_t>()});
  }
  result.stages.decided = json.at("stages").get<decltype(result.stages.decided)>();
  result.obligations = json.at("obligations").get<std::uint64_t>();
  result.cell_pairs = json.at("cell_pairs").get<std::uint64_t>();
  if (!json.at("first").is_null()) result.first = first_of(json.at("first"));
  result.goes_on = json.at("goes_on").get<bool>();
  return result;
}

Json near_json(const TooNear& near, bool witnessed) {
  return {{"cells", {near.first_cell, near.second_cell}}, {"time", near.time}, {"witnessed", witnessed}};
}

ListedNear near_of_json(const Json& json) {
  const Json& cells = json.at("cells");
  const TooNear pair{cells.at(0).get<std::uint32_t>(), cells.at(1).get<std::uint32_t>(), time_of(json.at("time"))};
  return {0, pair, json.at("witnessed").get<bool>()};
}

}  // namespace noli
