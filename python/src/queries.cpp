// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include <noli/contact.h>
#include <noli/errors.h>
#include <noli/time_of_impact.h>
#include "certify/queries/any_query.h"
#include "kernel/parallel.h"
#include "python/src/background.h"
#include "python/src/bindings.h"

namespace noli::python {
namespace {

namespace py = pybind11;

using Points = py::array_t<double, py::array::c_style>;

/// Where the answers go: a number for each query, or nowhere.
struct Answers {
  bool* touches;
  std::uint8_t* kind;
  double* time;
};

/// Copies a query. False if a number of it is not finite.
template <FeaturePair Pair, int Dim>
bool take_query(const double* x_t0, const double* x_t1, Query<Pair, Dim>& query) {
  constexpr std::size_t numbers = point_count(Pair) * Dim;
  std::memcpy(query.x_t0.data(), x_t0, numbers * sizeof(double));
  std::memcpy(query.x_t1.data(), x_t1, numbers * sizeof(double));
  double zero = 0;
  for (std::size_t i = 0; i < numbers; ++i) zero += (x_t0[i] - x_t0[i]) + (x_t1[i] - x_t1[i]);
  return zero == 0;
}

template <FeaturePair Pair, int Dim>
void answer(const Query<Pair, Dim>& query, std::size_t i, const Answers& answers) {
  answers.touches[i] = meet(query);
  if (answers.time == nullptr) return;
  answers.kind[i] = 0;
  answers.time[i] = std::numeric_limits<double>::quiet_NaN();
  if (!answers.touches[i]) return;
  const auto first = first_contact(query);
  answers.kind[i] = static_cast<std::uint8_t>(first->kind);
  answers.time[i] = first->time.lower();
}

/// Precondition: numbers of the shape (n, point_count, dimension). Throws InputError with the first query that has one
/// that is not finite.
template <FeaturePair Pair, int Dim>
void answer_all(const double* x_t0, const double* x_t1, std::size_t count, int threads, const Answers& answers,
                const std::atomic<bool>& stop) {
  constexpr std::size_t numbers = point_count(Pair) * Dim;
  std::atomic<std::size_t> bad = count;
  for_each_in_pieces(count, threads, [&](std::size_t i) {
    if (stop.load(std::memory_order_relaxed)) return;
    Query<Pair, Dim> query;
    if (take_query(x_t0 + i * numbers, x_t1 + i * numbers, query)) return answer(query, i, answers);
    std::size_t least = bad.load();
    while (i < least && !bad.compare_exchange_weak(least, i)) continue;
  });
  if (bad < count) {
    throw InputError("queries", "", fmt::format("query {} has a number that is not finite", bad.load()));
  }
}

template <class... Arguments>
void answer_typed(FeaturePair pair, int dimension, const Arguments&... arguments) {
  using enum FeaturePair;
  switch (pair) {
    case vertex_face: return answer_all<vertex_face, 3>(arguments...);
    case edge_edge: return answer_all<edge_edge, 3>(arguments...);
    case vertex_edge:
      return dimension == 2 ? answer_all<vertex_edge, 2>(arguments...) : answer_all<vertex_edge, 3>(arguments...);
    case vertex_vertex: break;
  }
  return dimension == 2 ? answer_all<vertex_vertex, 2>(arguments...) : answer_all<vertex_vertex, 3>(arguments...);
}

/// (touches, kind, time); kind and time are None without `times`.
py::tuple contacts(int pair, const Points& x_t0, const Points& x_t1, bool times, int threads) {
  const auto count = x_t0.shape(0);
  const auto dimension = static_cast<int>(x_t0.shape(2));
  py::array_t<bool> touches(count);
  py::array_t<std::uint8_t> kind(times ? count : 0);
  py::array_t<double> time(times ? count : 0);
  const Answers answers{touches.mutable_data(), kind.mutable_data(), times ? time.mutable_data() : nullptr};
  const double *const begin = x_t0.data(), *const end = x_t1.data();
  in_background([&](Background& background) {
    answer_typed(static_cast<FeaturePair>(pair), dimension, begin, end, static_cast<std::size_t>(count), threads,
                 answers, *background.stop());
  });
  if (!times) return py::make_tuple(touches, py::none(), py::none());
  return py::make_tuple(touches, kind, time);
}

}  // namespace

void bind_queries(py::module_& core) { core.def("contacts", &contacts); }

}  // namespace noli::python
