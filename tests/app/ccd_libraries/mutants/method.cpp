// SPDX-License-Identifier: Apache-2.0
//
// Implements an exact method of continuous collision detection as a library (include/noli/ccd_plugin.h), and the faults
// that can be planted in it (mutants.h). It uses rational arithmetic with the oracle's polynomials and algebraic times.
//
// Notation
//   x       points as polynomials of t with integer coefficients
//   volume  six times the signed volume of the tetrahedron of the four points: features can only meet at its roots, or
//           at any time if it is the zero polynomial
//   n       normal of the face, or of the two edges; where it is zero, the face is degenerate or the edges are
//           parallel, and only a vertex and an edge can meet
#include <noli/ccd_plugin.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "mutants.h"
#include "oracle/condition.h"
#include "oracle/integer_path.h"

namespace {

using namespace noli::oracle;
using noli::mutants::chosen;
using noli::mutants::Mutant;

bool is(Mutant mutant) { return chosen == mutant; }

// --- reading the input -----------------------------------------------------------------------------------------------

using Points = std::array<Coordinates, 4>;

Points points(const double* x) {
  Points result;
  for (std::size_t i = 0; i < 12; ++i) result[i / 3][i % 3] = x[i];
  return result;
}

double as_read(double x) {
  if (is(Mutant::single_precision) && std::isfinite(static_cast<float>(x))) return static_cast<float>(x);
  if (is(Mutant::subnormals_dropped) && std::abs(x) < std::numeric_limits<double>::min()) return 0;
  if (is(Mutant::snapped_to_a_grid) && std::abs(x) < 0x1p60) return std::ldexp(std::trunc(std::ldexp(x, 20)), -20);
  return x;
}

/// The difference, unless it overflows; so finite coordinates stay finite.
double difference(double a, double b) { return std::isfinite(a - b) ? a - b : a; }

Motion read(int kind, const double* x_t0, const double* x_t1) {
  const bool edges = kind == NOLI_CCD_EDGE_EDGE;
  Motion motion{edges ? Pair::edge_edge : Pair::vertex_face, 3, points(x_t0), points(x_t1)};
  const Coordinates origin = motion.x_t0[0];
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double &begin = motion.x_t0[i][axis], &end = motion.x_t1[i][axis];
      begin = as_read(begin);
      end = as_read(end);
      if (is(Mutant::moved_to_the_origin)) begin = difference(begin, origin[axis]), end = difference(end, origin[axis]);
      if (is(Mutant::displacement_rounded)) end = difference(begin, difference(begin, end));
    }
  }
  if (is(Mutant::coordinate_forgotten)) motion.x_t1[3][2] = motion.x_t0[3][2];
  if (is(Mutant::corners_swapped) && !edges) std::swap(motion.x_t1[2], motion.x_t1[3]);
  if (is(Mutant::edge_turned_round) && edges) std::swap(motion.x_t1[2], motion.x_t1[3]);
  return motion;
}

// --- early rejection -------------------------------------------------------------------------------------------------

struct Range {
  double least = std::numeric_limits<double>::infinity(), greatest = -std::numeric_limits<double>::infinity();
  void add(double x) { least = std::min(least, x), greatest = std::max(greatest, x); }
};

bool swept_boxes_overlap(const Motion& motion) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Range first, second;
    for (std::size_t i = 0; i < 4; ++i) {
      Range& range = i < first_count(motion.pair) ? first : second;
      range.add(motion.x_t0[i][axis]);
      if (!is(Mutant::boxes_of_the_beginning)) range.add(motion.x_t1[i][axis]);
    }
    if (first.greatest < second.least || second.greatest < first.least) return false;
    if (!is(Mutant::boxes_must_overlap)) continue;
    const bool flat = first.greatest == first.least || second.greatest == second.least;
    if (!flat && (first.greatest == second.least || second.greatest == first.least)) return false;
  }
  return true;
}

// --- when the four points are coplanar -------------------------------------------------------------------------------

using Vectors = std::vector<Vector>;

Polynomial volume(const Motion& motion, const Vectors& x) {
  const bool edges = motion.pair == Pair::edge_edge;
  const Vector p = x[1] - x[0], q = edges ? x[3] - x[2] : x[2] - x[0], r = edges ? x[2] - x[0] : x[3] - x[0];
  Vector n = cross(q, r);
  if (is(Mutant::sign_flipped)) n[1] = Polynomial() - n[1];
  const Polynomial result = dot(p, n);
  if (!is(Mutant::cubic_term_dropped) || result.degree() < 3) return result;
  return Polynomial({result[0], result[1], result[2]});
}

const Dyadic zero{0, 0}, one{1, 0};

std::vector<Time> roots(const Polynomial& volume) {
  std::vector<Time> times = Time::roots_of(volume);
  const auto is_double = [&](const Time& t) {
    return t.compare(zero) != 0 && t.compare(one) != 0 && !t.changes_sign(volume);
  };
  if (is(Mutant::endless_at_double_roots) && std::any_of(times.begin(), times.end(), is_double)) {
    for (volatile bool searching = true; searching;) {
    }
  }
  if (is(Mutant::crash_at_three_roots) && times.size() > 2) std::raise(SIGSEGV);
  if (is(Mutant::double_roots_dropped)) std::erase_if(times, is_double);
  if (is(Mutant::later_roots_dropped) && times.size() > 1) times.erase(times.begin() + 1, times.end());
  if (is(Mutant::first_root_dropped) && times.size() > 1) times.erase(times.begin());
  return times;
}

// --- whether they meet at that time ----------------------------------------------------------------------------------

/// The square of the normal, and the weights of the points multiplied by it.
struct Place {
  Polynomial square;
  std::vector<Polynomial> weights;
};

Place place_in_face(const Vectors& x) {
  const Vector v = x[0] - x[1], p = x[2] - x[1], q = x[3] - x[1], n = cross(p, q);
  const Polynomial square = dot(n, n), w = dot(cross(v, q), n), u = dot(cross(p, v), n);
  return {square, {square - w - u, w, u}};
}

Place place_in_edges(const Vectors& x) {
  const Vector p = x[1] - x[0], q = x[3] - x[2], d = x[2] - x[0], n = cross(p, q);
  const Polynomial square = dot(n, n), s = dot(cross(d, q), n), r = dot(cross(d, p), n);
  if (is(Mutant::edges_prolonged)) return {square, {s, square - s}};
  return {square, {s, square - s, r, square - r}};
}

Clause on_edge(const Vector& v, const Vector& e0, const Vector& e1) {
  const Vector p = e0 - v, q = e1 - v, area = cross(p, q);
  return {{area[0], area[1], area[2]}, {}, {Polynomial() - dot(p, q)}};
}

Clause inside(const Place& place, const Polynomial& volume) {
  if (is(Mutant::border_excluded)) {
    Clause clause{{volume}, place.weights, {}};
    clause.positive.push_back(place.square);
    return clause;
  }
  Clause clause{{volume}, {place.square}, place.weights};
  if (is(Mutant::root_rounded)) clause.zero.clear();
  const Polynomial million = Polynomial::constant(1000000);
  for (Polynomial& weight : clause.not_negative) {
    if (is(Mutant::tolerance_shrinks)) weight = weight * million - place.square;
  }
  return clause;
}

/// The condition of contact. Where the normal is zero, only a vertex and an edge can meet.
Condition meeting(const Motion& motion, const Vectors& x, const Polynomial& volume) {
  const bool edges = motion.pair == Pair::edge_edge;
  Condition condition = {inside(edges ? place_in_edges(x) : place_in_face(x), volume)};
  if (is(Mutant::border_excluded) || is(Mutant::tolerance_shrinks)) return condition;
  if (edges && !is(Mutant::parallel_edges_dropped)) {
    condition.push_back(on_edge(x[0], x[2], x[3]));
    condition.push_back(on_edge(x[1], x[2], x[3]));
    if (is(Mutant::parallel_inside_dropped)) return condition;
    condition.push_back(on_edge(x[2], x[0], x[1]));
    condition.push_back(on_edge(x[3], x[0], x[1]));
  }
  if (!edges && !is(Mutant::degenerate_face_dropped)) {
    condition.push_back(on_edge(x[0], x[1], x[2]));
    condition.push_back(on_edge(x[0], x[2], x[3]));
    condition.push_back(on_edge(x[0], x[3], x[1]));
  }
  return condition;
}

/// All times at which the condition may begin to hold, and the ends of the step.
std::vector<Time> critical_times(const Condition& condition) {
  std::vector<Time> times = Time::roots_of(Polynomial::linear(0, 1) * Polynomial::linear(1, 0));
  if (is(Mutant::coplanar_at_ends_only)) return times;
  for (const Clause& clause : condition) std::ranges::move(clause.critical_times(), std::back_inserter(times));
  sort_distinct(times);
  return times;
}

Time rounded(const Time& time) {
  const Dyadic t = exactly(time.lower());
  Integer scale = 1;
  scale <<= t.exponent;
  return Time::roots_of(Polynomial::linear(-t.numerator, scale - t.numerator)).at(0);
}

bool meet_at(const Condition& condition, const Time& t) {
  if (is(Mutant::beginning_excluded) && t.compare(zero) == 0) return false;
  if (is(Mutant::end_excluded) && t.compare(one) == 0) return false;
  if (is(Mutant::tolerance_of_time) && t.compare(1 - 1e-6) > 0) return false;
  if (is(Mutant::weights_at_the_beginning)) {
    Clause clause = condition[0];
    clause.zero.clear();
    return clause.holds_at(Time());
  }
  if (is(Mutant::root_rounded)) return holds_at(condition, rounded(t));
  return holds_at(condition, t);
}

// --- the answer ------------------------------------------------------------------------------------------------------

double told(const Time& t) {
  const double lower = t.lower(), next = std::nextafter(lower, 2);
  if (is(Mutant::one_ulp_late)) return next;
  if (is(Mutant::rounded_to_nearest)) return t.compare(middle(exactly(lower), exactly(next))) > 0 ? next : lower;
  if (is(Mutant::time_in_single)) return static_cast<float>(lower);
  return lower;
}

/// The time of impact, if there is one.
std::optional<double> impact(const Motion& motion) {
  if (!swept_boxes_overlap(motion)) return std::nullopt;
  const Vectors x = integer_paths(motion, Unit::per_axis).x;
  const Polynomial volume = ::volume(motion, x);
  const bool coplanar = volume.is_zero();
  if (is(Mutant::coplanar_dropped) && coplanar) return std::nullopt;
  if (is(Mutant::same_sign_same_side) && volume.sign_at(zero) * volume.sign_at(one) > 0) return std::nullopt;
  const Condition condition = meeting(motion, x, volume);
  std::vector<Time> times = coplanar ? critical_times(condition) : roots(volume);
  if (is(Mutant::last_contact)) std::reverse(times.begin(), times.end());
  const auto found = std::find_if(times.begin(), times.end(), [&](const Time& t) { return meet_at(condition, t); });
  if (found == times.end()) return std::nullopt;
  if (is(Mutant::no_time_when_coplanar) && coplanar) return std::numeric_limits<double>::quiet_NaN();
  return told(*found);
}

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double /*tolerance*/,
                              double* time_of_impact) {
  const std::optional<double> time = impact(read(kind, x_t0, x_t1));
  if (!time) return NOLI_CCD_NO_HIT;
  *time_of_impact = *time;
  return NOLI_CCD_HIT;
}
