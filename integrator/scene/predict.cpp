// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/predict.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "integrator/gravity_steps.h"
#include "integrator/groups.h"
#include "integrator/scene/scene.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// Kind and step of forces.
using ForceStep = std::pair<ForceKind, double>;

/// The forces of one kind and step at a vertex.
template <int Dim>
struct Pull {
  ForceStep force_step;
  Eigen::Matrix<double, Dim, Dim> squared_frequencies;  ///< of the vertex, with its neighbours at rest
};

/// The forces at each vertex.
template <int Dim>
struct AtVertices {
  std::vector<std::vector<Pull<Dim>>> pulls;  ///< by vertex, with different steps
  std::vector<std::uint8_t> held;             ///< by vertex: it cannot move
};

template <class F, int Dim>
void add_pulls(const F& force, double step, const Model<double, Dim>& model, AtVertices<Dim>& at) {
  end_if_stopped();
  VertexVectors<double, Dim, F::size> x;
  for (std::size_t i = 0; i < F::size; ++i) x[i] = model.x[force.vertices[i]];
  const auto gradients = force.measure_gradients(x);
  const auto stiffness = force.stiffness();
  for (std::size_t i = 0; i < F::size; ++i) {
    const VertexId v = force.vertices[i];
    if (at.held[v]) continue;
    const ForceStep force_step{F::kind, step};
    auto& pulls = at.pulls[v];
    auto pull = std::ranges::find(pulls, force_step, &Pull<Dim>::force_step);
    if (pull == pulls.end()) pull = pulls.insert(pulls.end(), {force_step, Eigen::Matrix<double, Dim, Dim>::Zero()});
    for (std::size_t j = 0; j < F::measures; ++j) {
      pull->squared_frequencies += (stiffness[j] / model.mass[v]) * gradients[j][i] * gradients[j][i].transpose();
    }
  }
}

/// The directions in which the fast forces let a vertex oscillate.
template <int Dim>
using Axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>;

/// Warnings by pairs of steps. If forces have clocks of their own, nearly all pairs of steps differ; then by kinds.
class Warnings {
 public:
  explicit Warnings(Clocks clocks) : by_step_(clocks == Clocks::grouped) {}

  void add(const ForceStep& slow, const ForceStep& fast, VertexId vertex, const Meeting& meeting) {
    ResonanceWarning& warning =
        by_pair_[{slow.first, by_step_ ? slow.second : 0, fast.first, by_step_ ? fast.second : 0}];
    auto& last = last_vertex_[&warning];
    if (warning.vertices == 0 || last != vertex) ++warning.vertices;
    last = vertex;
    if (meeting.strength <= warning.meeting.strength) return;
    warning = {slow.first, fast.first, slow.second, fast.second, warning.vertices, vertex, meeting};
  }

  std::vector<ResonanceWarning> list() const {
    std::vector<ResonanceWarning> warnings;
    for (const auto& [key, warning] : by_pair_) warnings.push_back(warning);
    return warnings;
  }

 private:
  bool by_step_;
  std::map<std::tuple<ForceKind, double, ForceKind, double>, ResonanceWarning> by_pair_;
  std::map<const ResonanceWarning*, VertexId> last_vertex_;  ///< the last vertex with this warning
};

/// Warns of slow forces in resonance with an oscillation of the fast ones.
template <int Dim>
void warn_of_resonances(const Pull<Dim>& slow, const ForceStep& fast, const Axes<Dim>& axes, VertexId vertex,
                        Warnings& warnings) {
  for (int k = 0; k < Dim; ++k) {
    const Eigen::Matrix<double, Dim, 1> axis = axes.eigenvectors().col(k);
    const double along = axis.dot(slow.squared_frequencies * axis), squared = axes.eigenvalues()[k];
    if (!(along > 1e-12 * squared) || !(squared > 0)) continue;  // the slow forces do not act along this axis
    const auto met = resonance({slow.force_step.second, std::sqrt(along)}, {fast.second, std::sqrt(squared)});
    if (met) warnings.add(slow.force_step, fast, vertex, *met);
  }
}

template <int Dim>
std::vector<ResonanceWarning> find_resonances(const AtVertices<Dim>& at, Clocks clocks) {
  Warnings warnings(clocks);
  for (VertexId v = 0; v < at.pulls.size(); ++v) {
    end_if_stopped();
    for (const Pull<Dim>& fast : at.pulls[v]) {
      const Axes<Dim> axes(fast.squared_frequencies);
      for (const Pull<Dim>& slow : at.pulls[v]) {
        if (slow.force_step.second <= fast.force_step.second) continue;
        warn_of_resonances(slow, fast.force_step, axes, v, warnings);
      }
    }
  }
  return warnings.list();
}

/// One group for each step, or one for all.
void add_groups(ForceKind kind, const std::vector<double>& steps, Clocks clocks, Explanation& explanation) {
  std::map<double, PredictedGroup, std::greater<>> groups;
  for (const double h : steps) {
    PredictedGroup& group = groups[clocks == Clocks::grouped ? h : 0];
    group.kind = kind;
    group.shortest = group.forces == 0 ? h : std::min(group.shortest, h);
    group.longest = std::max(group.longest, h);
    group.events += 1 / h;
    ++group.forces;
  }
  for (const auto& [step, group] : groups) {
    explanation.groups.push_back(group);
    explanation.events += group.events;
  }
}

/// Gravity also acts at the ends of windows that are not multiples of its steps.
template <int Dim>
void add_gravity_groups(const Model<double, Dim>& model, const AtVertices<Dim>& at, Explanation& explanation) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> of_forces(at.pulls.size(), never), steps;
  for (std::size_t v = 0; v < of_forces.size(); ++v) {
    for (const Pull<Dim>& pull : at.pulls[v]) of_forces[v] = std::min(of_forces[v], pull.force_step.second);
  }
  double at_ends = 0;
  for (const double h : steps_of_gravity(at.held, std::move(of_forces), *model.gravity).steps) {
    if (h == never) continue;
    steps.push_back(h);
    if (std::round(model.window_length / h) * h != model.window_length) at_ends += 1 / model.window_length;
  }
  if (steps.empty()) return;
  add_groups(ForceKind::gravity, steps, model.clocks, explanation);
  explanation.groups.back().events += at_ends;
  explanation.events += at_ends;
}

/// Breakpoints per second of a vertex that can move. Windows end at a rate of their own. Steps of groups divide each
/// other and the window, so the shortest one has the breakpoints of all; other steps share none.
template <int Dim>
double rate(const std::vector<Pull<Dim>>& pulls, const Model<double, Dim>& model) {
  std::set<double> steps{model.window_length};
  for (const Pull<Dim>& pull : pulls) steps.insert(pull.force_step.second);
  if (model.gravity) {
    const bool carried = !pulls.empty() && *steps.begin() <= model.gravity->step;
    const double longest = pulls.empty() ? model.gravity->step_without_forces : model.gravity->step;
    if (!carried) steps.insert(std::min(model.gravity->step, longest));
  }
  if (model.clocks == Clocks::grouped) return 1 / *steps.begin();
  double sum = 0;
  for (const double h : steps) sum += 1 / h;
  return sum;
}

template <int Dim>
double breakpoint_rate(const Scene& scene, const Model<double, Dim>& model, const AtVertices<Dim>& at) {
  double sum = 0;
  for (std::size_t v = 0; v < at.pulls.size(); ++v) sum += at.held[v] ? 1 / scene.window : rate(at.pulls[v], model);
  for (const auto& script : model.scripts) sum += static_cast<double>(script.times.size()) / scene.duration;
  return sum;
}

/// Bytes per second in the blocks of windows: a time and a position for each breakpoint, or positions for each frame,
/// and the state at the end.
template <int Dim>
double byte_rate(const Scene& scene, std::size_t vertices, double breakpoints) {
  constexpr double vector = 8.0 * Dim;
  const double n = static_cast<double>(vertices);
  if (scene.record == Record::full) return breakpoints * (8 + vector) + n * (8 + vector) / scene.window;
  return n * vector * scene.frame_rate + n * 2 * vector / scene.window;
}

}  // namespace

template <int Dim>
void predict(const Scene& scene, Model<double, Dim> model, Explanation& explanation) {
  AtVertices<Dim> at{std::vector<std::vector<Pull<Dim>>>(model.x.size()), held_vertices(model)};
  const auto look = [&]<class F>(ForceList<F>& list) {
    if (model.clocks == Clocks::grouped) make_groups(list, scene.window);
    for (std::size_t i = 0; i < list.forces.size(); ++i) add_pulls(list.forces[i], list.steps[i], model, at);
  };
  const auto add = [&]<class F>(const ForceList<F>& list) {
    add_groups(F::kind, list.steps, model.clocks, explanation);
  };
  std::apply([&look](auto&... lists) { (look(lists), ...); }, model.forces.lists());
  if (model.gravity) add_gravity_groups(model, at, explanation);
  std::apply([&add](const auto&... lists) { (add(lists), ...); }, model.forces.lists());
  explanation.windows = windows_up_to(scene.duration, scene.window);
  explanation.breakpoints = breakpoint_rate(scene, model, at);
  explanation.breakpoints_a_window = explanation.breakpoints * scene.window;
  explanation.bytes = byte_rate<Dim>(scene, model.x.size(), explanation.breakpoints);
  explanation.bytes_in_all = explanation.bytes * scene.duration;
  explanation.resonances = find_resonances(at, model.clocks);
}

template void predict(const Scene&, Model<double, 2>, Explanation&);
template void predict(const Scene&, Model<double, 3>, Explanation&);

}  // namespace noli::integrator
