// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/step_json.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>

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

/// A whole number below `end`.
template <class Number = std::uint64_t>
Number whole(const Json& json, std::uint64_t end = ~std::uint64_t{0}) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() >= end) {
    throw std::invalid_argument("a number that is not below " + std::to_string(end));
  }
  return static_cast<Number>(json.get<std::uint64_t>());
}

template <std::size_t Size>
std::array<std::uint64_t, Size> counts_of(const Json& json) {
  std::array<std::uint64_t, Size> counts{};
  if (json.size() != Size) throw std::invalid_argument("a list of another length");
  for (std::size_t i = 0; i < Size; ++i) counts[i] = whole(json.at(i));
  return counts;
}

double time_of(const Json& json, StepTimes times) {
  const auto time = json.get<double>();
  if (!(time >= times.begin && time <= times.end)) throw std::invalid_argument("a time that is not in the step");
  return time;
}

std::uint32_t cell_of(const Json& json, const Mesh& mesh) { return whole<std::uint32_t>(json, mesh.cell_count()); }

Json contact_as_json(const FeatureContact& contact) {
  return {name(contact.pair), contact.vertices, contact.first.begin, contact.first.end};
}

/// Those that share a vertex are not compared.
void require_two_features(const FeatureContact& contact) {
  const std::span<const VertexId> all(contact.vertices.data(), point_count(contact.pair));
  const auto first = all.first(first_size(contact.pair)), second = all.subspan(first.size());
  for (const VertexId v : first) {
    if (std::ranges::find(second, v) != second.end()) throw std::invalid_argument("features that share a vertex");
  }
}

FeatureContact contact_of(const Json& json, const Mesh& mesh, StepTimes times) {
  FeatureContact contact;
  contact.pair = named<FeaturePair>(json.at(0), all_feature_pairs);
  for (std::size_t i = 0; i < contact.vertices.size(); ++i) {
    contact.vertices[i] = whole<VertexId>(json.at(1).at(i), mesh.vertex_count);
  }
  contact.first = {time_of(json.at(2), times), time_of(json.at(3), times)};
  if (contact.first.begin > contact.first.end) throw std::invalid_argument("a time that ends before it begins");
  require_two_features(contact);
  return contact;
}

Json first_as_json(const FirstInStep& first) {
  return {{"contact", contact_as_json(first.contact)}, {"kind", name(first.kind)}, {"time", first.time}};
}

FirstInStep first_of(const Json& json, const Mesh& mesh, StepTimes times) {
  return {contact_of(json.at("contact"), mesh, times), named<ContactKind>(json.at("kind"), contact_kinds),
          time_of(json.at("time"), times)};
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
          {"going_on", result.going_on},
          {"rests", result.rests}};
}

StepResult step_of_json(const Json& json, const Mesh& mesh, StepTimes times) {
  StepResult result;
  result.complete = json.at("complete").get<bool>();
  result.contacts = counts_of<std::tuple_size_v<ContactCounts>>(json.at("contacts"));
  result.initial_intersections = whole(json.at("initial_intersections"));
  for (const Json& contact : json.at("reports")) result.reports.push_back(contact_of(contact, mesh, times));
  for (const Json& pair : json.at("initial_reports")) {
    result.initial_reports.push_back({cell_of(pair.at(0), mesh), cell_of(pair.at(1), mesh)});
    const auto& [a, b] = result.initial_reports.back();
    if (a >= b) throw std::invalid_argument("cells that are not in ascending order");
  }
  result.stages.decided = counts_of<std::tuple_size_v<decltype(result.stages.decided)>>(json.at("stages"));
  result.obligations = whole(json.at("obligations"));
  result.cell_pairs = whole(json.at("cell_pairs"));
  if (!json.at("first").is_null()) result.first = first_of(json.at("first"), mesh, times);
  result.going_on = whole(json.at("going_on"));
  result.rests = json.at("rests").get<bool>();
  if (result.reports.size() > result.contact_count() || result.initial_reports.size() > result.initial_intersections) {
    throw std::invalid_argument("more contacts are listed than there are");
  }
  if (result.contact_count() > 0 && !result.first) throw std::invalid_argument("contacts, of which none is the first");
  return result;
}

Json near_json(const TooNear& near, bool witnessed) {
  return {{"cells", {near.first_cell, near.second_cell}}, {"time", near.time}, {"witnessed", witnessed}};
}

ListedNear near_of_json(const Json& json, const Mesh& mesh) {
  const Json& cells = json.at("cells");
  const TooNear pair{cell_of(cells.at(0), mesh), cell_of(cells.at(1), mesh), time_of(json.at("time"), {})};
  return {0, pair, json.at("witnessed").get<bool>()};
}

}  // namespace noli
