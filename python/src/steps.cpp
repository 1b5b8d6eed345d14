// SPDX-License-Identifier: Apache-2.0
#include <noli/sequence.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/groups.h"
#include "certify/listed_contacts.h"
#include "certify/proofs/largest_distance.h"
#include "certify/verification.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/bindings.h"
#include "python/src/frames.h"
#include "trajectory/sample.h"

namespace noli::python {
namespace {

namespace py = pybind11;

std::vector<Position> finite(const py::array& array) {
  std::vector<Position> x = PositionArray(array).frame(0);
  for (std::size_t v = 0; v < x.size(); ++v) {
    for (const double number : x[v]) {
      if (std::isfinite(number)) continue;
      throw InputError("positions", "vertex " + std::to_string(v),
                       "expected a finite number, found " + std::to_string(number));
    }
  }
  return x;
}

/// One step of a mesh after another, or one moment.
class Steps {
 public:
  /// `mesh`: a noli.CollisionMesh.
  Steps(const py::object& mesh, std::size_t vertices, int dimension, bool at_rest, int threads, std::size_t max_reports)
      : mesh_(mesh_of(mesh, vertices)) {
    options_.dimension = dimension;
    options_.at_rest = at_rest;
    options_.threads = threads;
    options_.max_reports = std::max<std::size_t>(max_reports, 1);
    options_.stop = &stop_;
    if (const auto ignored = ignored_groups_of(mesh, vertices, false)) {
      groups_ = std::make_unique<const Groups>(read_groups(ignored->file, vertices));
      require_whole_cells(ignored->file, *groups_, mesh_);
      options_.exclusions = &groups_->exclusions;
    }
    verifier_.emplace(mesh_, options_);
  }

  /// Whether it touches; then first() and the lists say what.
  bool step(const py::array& x_t0, const py::array& x_t1) {
    const auto alone = one_at_a_time_.enter();
    x_t0_ = finite(x_t0);
    x_t1_ = finite(x_t1);
    in_background(stop_, [this](Background&) {
      decide();
      place_first();
    });
    return result_.touches();
  }

  /// {pair, kind, time, vertices, point}, or None: nothing touches, or cells intersect from the beginning.
  py::object first() const {
    if (!result_.first) return py::none();
    const FirstInStep& first = *result_.first;
    const auto size = static_cast<std::ptrdiff_t>(point_count(first.contact.pair));
    const std::vector<VertexId> vertices(first.contact.vertices.begin(), first.contact.vertices.begin() + size);
    py::dict found;
    found["pair"] = static_cast<int>(first.contact.pair);
    found["kind"] = static_cast<int>(first.kind);
    found["time"] = first.time;
    found["vertices"] = vertices;
    found["point"] = point_;
    return found;
  }

  /// (n, 5): a pair of features and its vertices, -1 where it has fewer than four.
  py::array_t<std::int64_t> pairs() const {
    py::array_t<std::int64_t> rows({static_cast<py::ssize_t>(result_.reports.size()), py::ssize_t{5}});
    for (std::size_t i = 0; i < result_.reports.size(); ++i) {
      const FeatureContact& contact = result_.reports[i];
      const auto row = static_cast<py::ssize_t>(i);
      rows.mutable_at(row, 0) = static_cast<std::int64_t>(contact.pair);
      for (std::size_t j = 0; j < 4; ++j) {
        const bool there = j < point_count(contact.pair);
        rows.mutable_at(row, static_cast<py::ssize_t>(j) + 1) =
            there ? static_cast<std::int64_t>(contact.vertices[j]) : -1;
      }
    }
    return rows;
  }

  std::uint64_t contact_count() const { return result_.contact_count(); }
  std::uint64_t intersection_count() const { return result_.initial_intersections; }

  /// (n, 2): cells that intersect at the beginning.
  py::array_t<std::int64_t> intersections() const {
    py::array_t<std::int64_t> rows({static_cast<py::ssize_t>(result_.initial_reports.size()), py::ssize_t{2}});
    for (std::size_t i = 0; i < result_.initial_reports.size(); ++i) {
      rows.mutable_at(static_cast<py::ssize_t>(i), 0) = result_.initial_reports[i].first_cell;
      rows.mutable_at(static_cast<py::ssize_t>(i), 1) = result_.initial_reports[i].second_cell;
    }
    return rows;
  }

  /// A share of the step, the positions there as x_t1 has numbers, and whether straight lines from x_t0 to those were
  /// decided to touch nothing: always, unless x_t0 touches itself.
  py::tuple free_step(const py::array& x_t0, const py::array& x_t1, double safety) {
    const auto alone = one_at_a_time_.enter();
    const bool single = x_t1.dtype().is(py::dtype::of<float>());
    const std::vector<Position> target = finite(x_t1);
    x_t0_ = finite(x_t0);
    x_t1_ = target;
    double share = 1;
    in_background(stop_, [&](Background&) {
      decide_anew();
      const bool stuck = result_.initial_intersections > 0;
      while (result_.touches() && share > 0 && !stop_) {
        share = share == 1 && result_.first ? safety * result_.first->time : share / 2;
        if (share < least_share || stuck) share = 0;
        go_to(target, share, single);
        if (!stuck) decide_anew();
      }
    });
    return py::make_tuple(share, array_of(x_t1_), !result_.touches());
  }

  /// The largest least distance at x: (allowed, limit), or None if there are no two features to compare. 0 if it
  /// intersects itself.
  py::object largest_distance(const py::array& x, std::uint32_t ring) {
    const auto alone = one_at_a_time_.enter();
    x_t0_ = x_t1_ = finite(x);
    std::optional<LargestDistance> found;
    in_background(stop_, [&](Background&) {
      SequenceOptions resting = options_;
      resting.at_rest = true;
      SequenceVerifier now(mesh_, resting);
      if (now.step(x_t0_, x_t0_).touches()) {
        found = LargestDistance{0, 0};
        return;
      }
      WindowOptions windows{now.step_options(), {}, options_.exclusions, nullptr};
      const WindowVerifier verifier(mesh_, x_t0_, windows);
      const MeshPaths paths(mesh_, ring);
      found = noli::largest_distance(verifier, mesh_, x_t0_, {extent(), &paths}, windows);
    });
    if (!found) return py::none();
    return py::make_tuple(found->allowed, found->limit);
  }

 private:
  static constexpr double least_share = 0x1p-60;

  /// As the first step of a motion, so that what meets at its beginning counts.
  void decide_anew() {
    verifier_.emplace(mesh_, options_);
    decide();
  }

  void decide() { result_ = verifier_->step(x_t0_, x_t1_); }

  /// Where the first contact is, if there is one.
  void place_first() {
    if (!result_.first) return;
    const FirstInStep& first = *result_.first;
    const std::size_t size = point_count(first.contact.pair);
    std::array<Position, 4> x{};
    for (std::size_t i = 0; i < size; ++i) {
      const VertexId v = first.contact.vertices[i];
      x[i] = sample_between(x_t0_[v], x_t1_[v], first.time);
    }
    point_ = meeting_point(first.contact.pair, options_.dimension, std::span<const Position>(x.data(), size));
  }

  /// Puts x_t1 on the way to the target, rounded to single precision if that is what the target has.
  void go_to(const std::vector<Position>& target, double share, bool single) {
    for (std::size_t v = 0; v < target.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double from = x_t0_[v][axis], x = from + share * (target[v][axis] - from);
        x_t1_[v][axis] = share == 0 ? from : single ? static_cast<double>(static_cast<float>(x)) : x;
      }
    }
  }

  /// Greater than any distance in x.
  double extent() const {
    double sum = 0;
    for (const Position& x : x_t0_) {
      for (std::size_t axis = 0; axis < 3; ++axis) sum = std::max(sum, std::abs(x[axis]));
    }
    return std::min(8 * sum, std::numeric_limits<double>::max() / 4);
  }

  OneAtATime one_at_a_time_;
  Mesh mesh_;
  SequenceOptions options_;
  std::unique_ptr<const Groups> groups_;
  std::atomic<bool> stop_ = false;
  std::optional<SequenceVerifier> verifier_;
  std::vector<Position> x_t0_, x_t1_;
  StepResult result_;
  Position point_{};  ///< of its first contact
};

}  // namespace

void bind_steps(py::module_& core) {
  py::class_<Steps>(core, "Steps")
      .def(py::init<const py::object&, std::size_t, int, bool, int, std::size_t>())
      .def("step", &Steps::step)
      .def("first", &Steps::first)
      .def("pairs", &Steps::pairs)
      .def("contact_count", &Steps::contact_count)
      .def("intersection_count", &Steps::intersection_count)
      .def("intersections", &Steps::intersections)
      .def("free_step", &Steps::free_step)
      .def("largest_distance", &Steps::largest_distance);
}

}  // namespace noli::python
