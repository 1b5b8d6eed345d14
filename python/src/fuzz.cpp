// SPDX-License-Identifier: Apache-2.0
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "python/src/background.h"
#include "python/src/bindings.h"
#ifdef NOLI_WITH_AUDIT
#include "audit/ccd/library_answers.h"
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/query_generators.h"
#include "audit/fuzz/queries/saved_query.h"
#endif

namespace noli::python {

namespace py = pybind11;

#ifdef NOLI_WITH_AUDIT
namespace {

using Points = py::array_t<double, py::array::c_style>;

/// The generators that make queries of this pair in 3D.
std::vector<const audit::QueryGenerator*> generators_of(FeaturePair pair) {
  std::vector<const audit::QueryGenerator*> found;
  for (const audit::QueryGenerator& generator : audit::query_generators()) {
    if (audit::is_library_query(generator.type) && generator.type.pair == pair) found.push_back(&generator);
  }
  return found;
}

void put_points(const std::array<Point3, 4>& points, double* place) {
  for (const Point3& point : points) place = std::copy(point.begin(), point.end(), place);
}

std::array<Point3, 4> points_at(const double* place) {
  std::array<Point3, 4> points{};
  for (Point3& point : points) {
    for (double& x : point) x = *place++;
  }
  return points;
}

/// (names, x_t0, x_t1): `each` queries of every generator for the pair, those of a seed and a round.
py::tuple adversarial_queries(int pair, std::uint64_t seed, std::uint64_t round, std::size_t each) {
  const auto generators = generators_of(static_cast<FeaturePair>(pair));
  const auto count = static_cast<py::ssize_t>(generators.size() * each);
  std::vector<std::string> names;
  Points x_t0({count, py::ssize_t{4}, py::ssize_t{3}}), x_t1({count, py::ssize_t{4}, py::ssize_t{3}});
  double *begin = x_t0.mutable_data(), *end = x_t1.mutable_data();
  in_background([&](Background&) {
    for (std::size_t g = 0; g < generators.size(); ++g) {
      audit::Random random(seed, round * generators.size() + g);
      names.push_back(generators[g]->name());
      for (std::size_t i = 0; i < each; ++i, begin += 12, end += 12) {
        const AnyQuery query = (*generators[g])(random).query;
        put_points(query.x_t0, begin);
        put_points(query.x_t1, end);
      }
    }
  });
  return py::make_tuple(names, x_t0, x_t1);
}

AnyQuery query_of(int pair, const Points& x_t0, const Points& x_t1) {
  return {static_cast<FeaturePair>(pair), 3, points_at(x_t0.data()), points_at(x_t1.data())};
}

/// A simpler query of which `fails(x_t0, x_t1)`, (n, 4, 3) each, still says the number of one that fails, or None.
py::tuple simpler_query(int pair, const Points& x_t0, const Points& x_t1, const py::function& fails,
                        std::size_t budget) {
  const audit::FirstFailure first_failure = [&](std::span<const AnyQuery> candidates) {
    const auto count = static_cast<py::ssize_t>(candidates.size());
    Points begin({count, py::ssize_t{4}, py::ssize_t{3}}), end({count, py::ssize_t{4}, py::ssize_t{3}});
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      put_points(candidates[i].x_t0, begin.mutable_data() + 12 * i);
      put_points(candidates[i].x_t1, end.mutable_data() + 12 * i);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return fails(begin, end).cast<std::optional<std::size_t>>();
  };
  const AnyQuery simpler = audit::minimise(query_of(pair, x_t0, x_t1), first_failure, budget);
  Points begin({4, 3}), end({4, 3});
  put_points(simpler.x_t0, begin.mutable_data());
  put_points(simpler.x_t1, end.mutable_data());
  return py::make_tuple(begin, end);
}

/// A file that `noli ccd` and `noli audit ccd` read.
void save_query(const std::filesystem::path& file, int pair, const Points& x_t0, const Points& x_t1, bool contact,
                const std::vector<std::string>& comments) {
  audit::save_query(file, query_of(pair, x_t0, x_t1), contact, comments);
}

}  // namespace

void bind_fuzz(py::module_& core) {
  core.def("adversarial_queries", &adversarial_queries);
  core.def("simpler_query", &simpler_query);
  core.def("save_query", &save_query);
}
#else
void bind_fuzz(py::module_& /*core*/) {}
#endif

}  // namespace noli::python
