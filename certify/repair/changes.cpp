// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/changes.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "certify/json.h"

namespace noli {

namespace {

/// JSON has no infinity, which a square may come to.
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

}  // namespace

std::string Changes::add(RepairedStep step, const Position& momentum, std::span<const Position> x,
                         std::span<const Position> y) {
  Distances all;
  std::vector<Distances> of_body(bodies_.size());
  std::size_t body = 0;
  for (VertexId v = 0; v < x.size(); ++v) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) square += (x[v][k] - y[v][k]) * (x[v][k] - y[v][k]);
    const double distance = std::sqrt(square);
    if (!(distance > 0)) continue;
    all.add(v, distance);
    while (body < bodies_.size() && v - bodies_[body].first_vertex >= bodies_[body].vertices) ++body;
    if (body < bodies_.size()) of_body[body].add(v, distance);
  }
  step.moved = all.moved();
  step.largest = all.largest();
  step.rms = all.root_mean_square();
  step.vertex = all.vertex();
  Json bodies = Json::array();
  for (const Distances& d : of_body) bodies.push_back({d.moved(), d.squares(), d.largest(), d.vertex()});
  add(step, momentum, of_body);
  const Json line = {{"step", step.step},       {"inserted", step.inserted}, {"moved", step.moved},
                     {"largest", step.largest}, {"rms", step.rms},           {"vertex", step.vertex},
                     {"deepest", step.deepest}, {"momentum", momentum},      {"bodies", bodies}};
  return line.dump();
}

void Changes::add_line(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    RepairedStep step;
    json.at("step").get_to(step.step);
    json.at("inserted").get_to(step.inserted);
    json.at("moved").get_to(step.moved);
    step.largest = number(json.at("largest"));
    step.rms = number(json.at("rms"));
    json.at("vertex").get_to(step.vertex);
    json.at("deepest").get_to(step.deepest);
    std::vector<Distances> of_body;
    for (const Json& d : json.at("bodies")) {
      of_body.emplace_back().add(d.at(0).get<std::uint64_t>(), number(d.at(1)), number(d.at(2)),
                                 d.at(3).get<VertexId>());
    }
    if (of_body.size() != bodies_.size()) throw std::invalid_argument("other bodies");
    if (step.vertex >= fixed_.size()) throw std::invalid_argument("no such vertex");
    add(step, json.at("momentum").get<Position>(), of_body);
  } catch (const Json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

void Changes::add(const RepairedStep& step, const Position& momentum, const std::vector<Distances>& of_body) {
  steps_.push_back(step);
  for (std::size_t k = 0; k < 3; ++k) momentum_[k] += momentum[k];
  for (std::size_t i = 0; i < of_body.size(); ++i) {
    of_body_[i].add(of_body[i].moved(), of_body[i].squares(), of_body[i].largest(), of_body[i].vertex());
  }
}

std::vector<RepairedBody> Changes::by_body() const {
  std::vector<RepairedBody> all;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Distances& d = of_body_[i];
    const auto body = fixed_.subspan(bodies_[i].first_vertex, bodies_[i].vertices);
    const bool fixed = std::ranges::all_of(body, [](std::uint8_t of) { return of != 0; });
    all.push_back({bodies_[i].name, fixed, d.moved(), d.largest(), d.root_mean_square()});
  }
  return all;
}

}  // namespace noli
