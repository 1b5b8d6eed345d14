// SPDX-License-Identifier: Apache-2.0
#include "bench/cloth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "integrator/stable_step.h"

namespace noli::bench {
namespace {

using integrator::Hinge;
using integrator::Model;
using Vec = integrator::Vec<double, 3>;

constexpr double mass_per_area = 0.2, stiffness = 60;

/// From 0 to 1, widths between growing by `grading` from the first to the last.
double graded(int i, int n, double grading) {
  const double s = static_cast<double>(i) / n;
  return (s + 0.5 * (grading - 1) * s * s) / (1 + 0.5 * (grading - 1));
}

class Builder {
 public:
  Builder(int cells, double grading) : n_(cells), rigidity_(0.1 * stiffness / (cells * cells)) {
    for (int j = 0; j <= n_; ++j) {
      for (int i = 0; i <= n_; ++i) add_vertex({graded(i, n_, grading), static_cast<double>(j) / n_, 0});
    }
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) {
        add_face(id(i, j), id(i + 1, j), id(i + 1, j + 1));
        add_face(id(i, j), id(i + 1, j + 1), id(i, j + 1));
      }
    }
    model_.mesh.vertex_count = model_.x.size();
    model_.pinned = {id(0, n_), id(n_, n_)};
  }

  Model<double, 3> take() && { return std::move(model_); }

 private:
  VertexId id(int i, int j) const { return static_cast<VertexId>(j * (n_ + 1) + i); }

  void add_vertex(const Vec& x) {
    rest_.push_back(x);
    const double wave = x[0] * (1 - x[0]) * x[1];
    model_.x.emplace_back(x + Vec(0, 0, 0.1 * wave));
    model_.v.emplace_back(0, 0, wave);
    model_.mass.push_back(0);
  }

  void add_face(VertexId a, VertexId b, VertexId c) {
    model_.mesh.faces.push_back({a, b, c});
    const double area = 0.5 * (rest_[b] - rest_[a]).cross(rest_[c] - rest_[a]).norm();
    for (const VertexId v : {a, b, c}) model_.mass[v] += mass_per_area * area / 3;
    add_edge(a, b, c);
    add_edge(b, c, a);
    add_edge(c, a, b);
  }

  /// A spring when it is new, a hinge when it has been seen from the other side.
  void add_edge(VertexId a, VertexId b, VertexId opposite) {
    const auto [other, is_new] = opposite_.try_emplace(std::minmax(a, b), opposite);
    if (is_new) {
      model_.forces.edge_springs.add({{a, b}, stiffness, (rest_[b] - rest_[a]).norm(), 0}, 1);
      return;
    }
    const std::array<VertexId, 4> v = {a, b, opposite, other->second};
    model_.forces.hinges.add(
        Hinge<double>::from_rest(v, {rest_[v[0]], rest_[v[1]], rest_[v[2]], rest_[v[3]]}, rigidity_), 1);
  }

  int n_;
  double rigidity_;
  std::vector<Vec> rest_;
  std::map<std::pair<VertexId, VertexId>, VertexId> opposite_;
  Model<double, 3> model_;
};

}  // namespace

Model<double, 3> cloth(int cells, double grading, integrator::Clocks clocks) {
  Model<double, 3> model = Builder(cells, grading).take();
  std::vector<double> inverse_mass;
  for (const double m : model.mass) inverse_mass.push_back(1 / m);
  for (const VertexId v : model.pinned) inverse_mass[v] = 0;
  double longest = 0;
  const auto choose = [&](auto& list) {
    list.steps = integrator::stable_steps(list, model.x, inverse_mass);
    for (const double h : list.steps) longest = std::max(longest, h);
  };
  std::apply([&](auto&... list) { (choose(list), ...); }, model.forces.lists());
  model.window_length = 32 * longest;
  model.clocks = clocks;
  return model;
}

}  // namespace noli::bench
