// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/pinch.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <noli/contact.h>
#include <noli/time_of_impact.h>
#include "integrator/scene/shapes/connectivity.h"
#include "kernel/static_predicates.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

template <std::size_t N>
using Simplices = std::vector<std::array<VertexId, N>>;

/// The features of a body that forces cannot move.
struct Tool {
  std::size_t body = 0;
  Simplices<1> vertices;
  Simplices<2> edges;
  Simplices<3> faces;
  std::set<double> times;  ///< breakpoints of its scripts; empty if it rests
};

template <std::size_t N>
Simplices<N> of_body(const Simplices<N>& cells, const BuiltBody& body) {
  Simplices<N> result;
  for (const auto& cell : cells) {
    if (body.has(cell[0])) result.push_back(cell);
  }
  return result;
}

template <int Dim>
Tool make_tool(const BuiltScene<Dim>& scene, std::size_t index) {
  const BuiltBody& body = scene.bodies[index];
  Tool tool;
  tool.body = index;
  for (VertexId i = 0; i < body.vertices; ++i) tool.vertices.push_back({body.first + i});
  Mesh faces;
  faces.vertex_count = scene.model.mesh.vertex_count;
  tool.faces = faces.faces = of_body(scene.model.mesh.faces, body);
  tool.edges = of_body(scene.model.mesh.edges, body);
  for (const FaceEdge& edge : face_edges(faces)) tool.edges.push_back(edge.ends);
  for (const auto& script : scene.model.scripts) {
    if (body.has(script.vertex)) tool.times.insert(script.times.begin(), script.times.end());
  }
  return tool;
}

/// Positions of all vertices of all tools at the ends of a time interval.
template <int Dim>
class Motion {
 public:
  explicit Motion(const Model<double, Dim>& model) : model_(model) {
    for (const auto& script : model.scripts) scripts_[script.vertex] = &script;
  }

  Point<Dim> at(VertexId i, double t) const {
    const auto found = scripts_.find(i);
    return point(found == scripts_.end() ? model_.x[i] : along(*found->second, t));
  }

 private:
  static Point<Dim> point(const Vec<double, Dim>& x) {
    Point<Dim> p;
    for (std::size_t axis = 0; axis < Dim; ++axis) p[axis] = x[static_cast<int>(axis)];
    return p;
  }

  static Vec<double, Dim> along(const Script<double, Dim>& script, double t) {
    const auto after = std::upper_bound(script.times.begin(), script.times.end(), t);
    const auto k = static_cast<std::size_t>(after - script.times.begin());
    if (k == 0) return script.positions.front();
    if (k == script.times.size()) return script.positions.back();
    const double part = (t - script.times[k - 1]) / (script.times[k] - script.times[k - 1]);
    return script.positions[k - 1] + part * (script.positions[k] - script.positions[k - 1]);
  }

  const Model<double, Dim>& model_;
  std::map<VertexId, const Script<double, Dim>*> scripts_;
};

/// The box around some points.
template <int Dim>
struct Around {
  Point<Dim> low, high;

  template <class Points>
  explicit Around(const Points& points) : low(points[0]), high(points[0]) {
    for (const Point<Dim>& p : points) {
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }

  bool meets(const Around& other) const {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      if (low[axis] > other.high[axis] || other.low[axis] > high[axis]) return false;
    }
    return true;
  }
};

template <int Dim>
class Search {
 public:
  Search(const Motion<Dim>& motion, const Tool& a, const Tool& b, double duration)
      : motion_(motion), a_(a), b_(b), times_{0, duration} {
    for (const Tool* tool : {&a, &b}) times_.insert(tool->times.begin(), tool->times.lower_bound(duration));
  }

  std::optional<double> first_meeting() {
    if (meet_at_start()) return std::nullopt;
    for (auto t = times_.begin(); std::next(t) != times_.end(); ++t) {
      if (const std::optional<double> meeting = first_in(*t, *std::next(t))) return meeting;
    }
    return std::nullopt;
  }

 private:
  template <std::size_t N>
  std::array<Point<Dim>, N> at(const std::array<VertexId, N>& cell, double t) const {
    std::array<Point<Dim>, N> points;
    for (std::size_t i = 0; i < N; ++i) points[i] = motion_.at(cell[i], t);
    return points;
  }

  template <std::size_t N>
  struct Moving {
    std::array<Point<Dim>, N> begin, end;
    Around<Dim> around;
  };

  template <std::size_t N>
  std::vector<Moving<N>> moving(const Simplices<N>& cells, double begin, double end) const {
    std::vector<Moving<N>> result;
    for (const auto& cell : cells) {
      end_if_stopped();
      const auto x = at(cell, begin), y = at(cell, end);
      std::array<Point<Dim>, 2 * N> both;
      std::copy(x.begin(), x.end(), both.begin());
      std::copy(y.begin(), y.end(), both.begin() + N);
      result.push_back({x, y, Around<Dim>(both)});
    }
    return result;
  }

  template <std::size_t N, std::size_t M>
  static bool any_intersect(const std::vector<Moving<N>>& as, const std::vector<Moving<M>>& bs) {
    for (const Moving<N>& a : as) {
      for (const Moving<M>& b : bs) {
        end_if_stopped();
        if (a.around.meets(b.around) && intersects(a.begin, b.begin)) return true;
      }
    }
    return false;
  }

  bool meet_at_start() const {
    const auto edges_a = moving(a_.edges, 0, 0), edges_b = moving(b_.edges, 0, 0);
    if constexpr (Dim == 2) {
      return any_intersect(edges_a, edges_b);
    } else {
      const auto faces_a = moving(a_.faces, 0, 0), faces_b = moving(b_.faces, 0, 0);
      return any_intersect(faces_a, faces_b) || any_intersect(edges_a, faces_b) || any_intersect(edges_b, faces_a);
    }
  }

  /// Keeps the earliest contact of features of two kinds, as a share of the step.
  template <FeaturePair Pair, std::size_t N, std::size_t M>
  void look(const std::vector<Moving<N>>& as, const std::vector<Moving<M>>& bs, std::optional<double>& earliest) const {
    for (const Moving<N>& a : as) {
      end_if_stopped();
      for (const Moving<M>& b : bs) {
        end_if_stopped();
        if (!a.around.meets(b.around)) continue;
        Query<Pair, Dim> query;
        std::copy(a.begin.begin(), a.begin.end(), query.x_t0.begin());
        std::copy(b.begin.begin(), b.begin.end(), query.x_t0.begin() + N);
        std::copy(a.end.begin(), a.end.end(), query.x_t1.begin());
        std::copy(b.end.begin(), b.end.end(), query.x_t1.begin() + N);
        const std::optional<TimeEnclosure> found = contact(query);
        // A pair that stays in contact may have an enclosure as long as the step.
        if (!found || (earliest && found->begin >= *earliest)) continue;
        const double first = first_contact(query)->time.lower();
        if (!earliest || first < *earliest) earliest = first;
      }
    }
  }

  std::optional<double> first_in(double begin, double end) const {
    std::optional<double> earliest;
    const auto va = moving(a_.vertices, begin, end), vb = moving(b_.vertices, begin, end);
    const auto ea = moving(a_.edges, begin, end), eb = moving(b_.edges, begin, end);
    if constexpr (Dim == 2) {
      look<FeaturePair::vertex_edge>(va, eb, earliest);
      look<FeaturePair::vertex_edge>(vb, ea, earliest);
    } else {
      look<FeaturePair::vertex_face>(va, moving(b_.faces, begin, end), earliest);
      look<FeaturePair::vertex_face>(vb, moving(a_.faces, begin, end), earliest);
      look<FeaturePair::edge_edge>(ea, eb, earliest);
    }
    if (!earliest) return std::nullopt;
    return begin + *earliest * (end - begin);
  }

  const Motion<Dim>& motion_;
  const Tool &a_, &b_;
  std::set<double> times_;
};

}  // namespace

template <int Dim>
std::vector<Pinch> find_pinches(const BuiltScene<Dim>& scene, double duration) {
  std::vector<Tool> tools;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BuiltBody& body = scene.bodies[b];
    if (body.pinned + body.scripted == body.vertices) tools.push_back(make_tool(scene, b));
  }
  const Motion<Dim> motion(scene.model);
  std::vector<Pinch> pinches;
  for (std::size_t a = 0; a < tools.size(); ++a) {
    for (std::size_t b = a + 1; b < tools.size(); ++b) {
      if (tools[a].times.empty() && tools[b].times.empty()) continue;
      const auto time = Search<Dim>(motion, tools[a], tools[b], duration).first_meeting();
      if (time) pinches.push_back({{tools[a].body, tools[b].body}, *time});
    }
  }
  return pinches;
}

template std::vector<Pinch> find_pinches(const BuiltScene<2>&, double);
template std::vector<Pinch> find_pinches(const BuiltScene<3>&, double);

}  // namespace noli::integrator
