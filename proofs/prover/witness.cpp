// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/witness.h"

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <span>

#include "noli/kernel/scaled_integers.h"
#include "noli/proofs/prover/feature_sides.h"
#include "noli/proofs/prover/features.h"
#include "noli/proofs/prover/integer_motion.h"
#include "noli/proofs/prover/polynomials.h"
#include "noli/proofs/prover/tokens.h"
#include "noli/trajectory/bytes.h"

namespace noli {

namespace {

using namespace witness;

using Weights = std::vector<std::pair<VertexId, Poly>>;

struct Found {
  std::uint32_t i = 0, j = 0;
  Weights p, q;
  Poly g;
  unsigned long e = 0;
  mpz_class l, u;
};

void put_poly(std::string& bytes, const Poly& f) {
  put(bytes, static_cast<std::uint8_t>(std::max<std::size_t>(f.size(), 1)));
  if (f.empty()) put_sint(bytes, Integer(0));
  for (const mpz_class& c : f) {
    Integer value;
    mpz_set(value.get(), c.get_mpz_t());
    put_sint(bytes, value);
  }
}

std::string encoded(const Found& found) {
  std::string bytes;
  put(bytes, found.i);
  put(bytes, found.j);
  for (const Weights* side : {&found.p, &found.q}) {
    put(bytes, static_cast<std::uint8_t>(side->size()));
    for (const auto& [v, weight] : *side) {
      put(bytes, v);
      put_poly(bytes, weight);
    }
  }
  put_poly(bytes, found.g);
  put_uint(bytes, found.e);
  for (const mpz_class* bound : {&found.l, &found.u}) {
    Integer value;
    mpz_set(value.get(), bound->get_mpz_t());
    put_sint(bytes, value);
  }
  return bytes;
}

PolyVector minus(const PolyVector& a, const PolyVector& b) {
  return {difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2])};
}
Poly inner(const PolyVector& a, const PolyVector& b) {
  return sum(sum(product(a[0], b[0]), product(a[1], b[1])), product(a[2], b[2]));
}
PolyVector cross(const PolyVector& a, const PolyVector& b) {
  const auto minor = [&](std::size_t i, std::size_t j) { return difference(product(a[i], b[j]), product(a[j], b[i])); };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

using Sides = FeatureSides;

/// The two features of a contact.
Sides sides_of(const FeatureContact& contact) {
  const auto& v = contact.vertices;
  switch (contact.pair) {
    case FeaturePair::vertex_face: return {{v[0]}, {v[1], v[2], v[3]}};
    case FeaturePair::edge_edge: return {{v[0], v[1]}, {v[2], v[3]}};
    case FeaturePair::vertex_edge: return {{v[0]}, {v[1], v[2]}};
    case FeaturePair::vertex_vertex: return {{v[0]}, {v[1]}};
  }
  return {};
}

class Search {
 public:
  explicit Search(const WitnessStep& step) : step_(step), motion_(step.lines, step.shift, step.dimension, step.eta) {}

  std::optional<Found> of_features(const FeatureContact& contact) {
    const Sides sides = sides_of(contact);
    const auto of_p = cells_with(sides.p), of_q = cells_with(sides.q);
    for (const std::uint32_t i : of_p) {
      for (const std::uint32_t j : of_q) {
        if (i == j && !step_.strict) continue;
        if (auto found = at_root(contact, sides)) {
          found->i = i;
          found->j = j;
          return found;
        }
        return at_some_time(contact, of_p, of_q);
      }
    }
    return std::nullopt;
  }

  /// At a time, the nearest points of some features of two cells that no short path joins.
  std::optional<Found> of_near(const TooNear& near, const MeshPaths& paths) const {
    const mpz_class at = part_of_step(near.time);
    const auto a = vertices_of(step_.mesh, near.first_cell), b = vertices_of(step_.mesh, near.second_cell);
    for (unsigned m = 1; m < 1U << a.size(); ++m) {
      for (unsigned n = 1; n < 1U << b.size(); ++n) {
        Sides s{chosen(a, m), chosen(b, n)};
        const bool swap = s.p.size() > s.q.size();
        if (swap) std::swap(s.p, s.q);
        const auto pair = pair_of(s);
        if (!pair || joined(s, paths)) continue;
        if (auto found = near_at(*pair, s, at)) {
          if (swap) std::swap(found->p, found->q);
          found->i = near.first_cell;
          found->j = near.second_cell;
          return found;
        }
      }
    }
    return std::nullopt;
  }

  std::optional<Found> of_cells(std::uint32_t i, std::uint32_t j) { return at_rest(i, j, begin(), 0); }

 private:
  static constexpr unsigned long first_bits = IntegerMotion::first_bits, most_bits = 900;
  static constexpr std::size_t most_cells = 64;

  /// If the nearest points of the features' planes and lines are in the features, and near enough.
  std::optional<Found> near_at(FeaturePair pair, const Sides& s, const mpz_class& at) const {
    const Segments segments(motion_, s.both(), at, first_bits);
    const auto place = [&](VertexId v) {
      PolyVector x;
      const auto numbers = segments.position_at(v, at, first_bits);
      for (std::size_t k = 0; k < 3; ++k) x[k] = trimmed({numbers[k]});
      return x;
    };
    Found found;
    Equation e = equation(pair, s, place);
    found.p = std::move(e.p);
    found.q = std::move(e.q);
    found.g = {-at, mpz_class(1) << first_bits};
    found.e = first_bits;
    found.l = found.u = at;
    mpz_class square = 0, total_p = 0, total_q = 0;
    std::array<mpz_class, 3> x{}, y{};
    if (!add_up(segments, found.p, at, total_p, x) || !add_up(segments, found.q, at, total_q, y)) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
      const mpz_class d = total_q * x[k] - total_p * y[k];
      square += d * d;
    }
    const mpz_class least = (segments.scale() * motion_.length(step_.eta) << first_bits) * total_p * total_q;
    return square <= least * least ? std::optional(found) : std::nullopt;
  }

  /// The sums of constant weights, and of weights times positions. False if a weight is negative or all are 0.
  static bool add_up(const Segments& segments, const Weights& side, const mpz_class& at, mpz_class& total,
                     std::array<mpz_class, 3>& x) {
    for (const auto& [v, weight] : side) {
      const mpz_class w = weight.empty() ? mpz_class(0) : weight[0];
      if (w < 0) return false;
      total += w;
      const auto position = segments.position_at(v, at, first_bits);
      for (std::size_t k = 0; k < 3; ++k) x[k] += w * position[k];
    }
    return total > 0;
  }

  std::vector<std::uint32_t> cells_with(const std::vector<VertexId>& vertices) const {
    std::vector<std::uint32_t> cells;
    for (std::uint32_t c = 0; c < step_.mesh.cell_count() && cells.size() < most_cells; ++c) {
      const auto v = corners(step_.mesh, c);
      const auto end = v.begin() + static_cast<std::ptrdiff_t>(corner_count(step_.mesh, c));
      if (std::ranges::all_of(vertices, [&](VertexId w) { return std::find(v.begin(), end, w) != end; }))
        cells.push_back(c);
    }
    return cells;
  }

  /// The condition that vanishes, and the weights of the nearest points.
  struct Equation {
    Poly f;
    Weights p, q;
  };

  /// `at` gives the position of a vertex.
  template <class At>
  static Equation equation(FeaturePair pair, const Sides& s, const At& at) {
    if (pair == FeaturePair::vertex_face) return vertex_face(s, at);
    if (pair == FeaturePair::edge_edge) return edge_edge(s, at);
    if (pair == FeaturePair::vertex_edge) return vertex_edge(s, at);
    return vertex_vertex(s, at);
  }

  template <class At>
  static Equation vertex_face(const Sides& s, const At& at) {
    const PolyVector x = at(s.p[0]);
    const std::array<PolyVector, 3> corner = {at(s.q[0]), at(s.q[1]), at(s.q[2])};
    const PolyVector n = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    Equation e{inner(n, minus(x, corner[0])), {{s.p[0], {1}}}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      e.q.push_back({s.q[i], inner(n, cross(minus(corner[(i + 1) % 3], x), minus(corner[(i + 2) % 3], x)))});
    }
    return e;
  }

  template <class At>
  static Equation edge_edge(const Sides& s, const At& at) {
    const PolyVector a = at(s.p[0]), c = at(s.q[0]);
    const PolyVector u = minus(at(s.p[1]), a), v = minus(at(s.q[1]), c), r = minus(c, a);
    const PolyVector n = cross(u, v);
    const Poly all = inner(n, n), along_u = inner(cross(r, v), n), along_v = inner(cross(r, u), n);
    return {inner(n, r),
            {{s.p[0], difference(all, along_u)}, {s.p[1], along_u}},
            {{s.q[0], difference(all, along_v)}, {s.q[1], along_v}}};
  }

  template <class At>
  static Equation vertex_edge(const Sides& s, const At& at) {
    const PolyVector a = at(s.q[0]), u = minus(at(s.q[1]), a), r = minus(at(s.p[0]), a);
    const PolyVector n = cross(u, r);
    const Poly all = inner(u, u), along = inner(r, u);
    return {common(n), {{s.p[0], {1}}}, {{s.q[0], difference(all, along)}, {s.q[1], along}}};
  }

  template <class At>
  static Equation vertex_vertex(const Sides& s, const At& at) {
    return {common(minus(at(s.p[0]), at(s.q[0]))), {{s.p[0], {1}}}, {{s.q[0], {1}}}};
  }

  /// What divides all three.
  static Poly common(const PolyVector& x) { return greatest_common_divisor(greatest_common_divisor(x[0], x[1]), x[2]); }

  mpz_class begin() const { return motion_.time(step_.lines.first_time()); }
  /// T0 and so much of the step, rounded down to a multiple of 2^-first_bits; times 2^first_bits.
  mpz_class part_of_step(double part) const {
    mpq_class at(part);
    at *= (motion_.time(step_.lines.last_time()) - begin()) << first_bits;
    mpz_class result;
    mpz_fdiv_q(result.get_mpz_t(), at.get_num_mpz_t(), at.get_den_mpz_t());
    return result + (begin() << first_bits);
  }

  /// At the root of the condition within the time of the contact, one after another of the parts into which
  /// breakpoints cut that.
  std::optional<Found> at_root(const FeatureContact& contact, const Sides& sides) const {
    const auto vertices = sides.both();
    const mpz_class end = motion_.fraction(contact.first.end, true);
    mpz_class from = motion_.fraction(contact.first.begin, false);
    const auto cuts = breakpoints_between(vertices, from, end);
    for (const mpz_class& to : cuts) {
      const Segments segments(motion_, vertices, from, first_bits);
      const Equation condition = equation(contact.pair, sides, [&](VertexId v) { return segments.position(v); });
      if (auto found = at_root_of(condition, from, to)) return found;
      from = to;
    }
    return std::nullopt;
  }

  /// Times of breakpoints between two times, and the second; at least that.
  std::vector<mpz_class> breakpoints_between(const std::vector<VertexId>& vertices, const mpz_class& from,
                                             const mpz_class& to) const {
    std::set<mpz_class> cuts = {to};
    for (const VertexId v : vertices) {
      const auto times = step_.lines.times(v);
      const auto time = [&](double t) { return mpz_class(motion_.time(t) << first_bits); };
      auto t = std::partition_point(times.begin(), times.end(), [&](double b) { return time(b) <= from; });
      for (; t != times.end() && time(*t) < to; ++t) cuts.insert(time(*t));
    }
    return {cuts.begin(), cuts.end()};
  }

  static std::optional<Found> at_root_of(const Equation& condition, const mpz_class& from, const mpz_class& to) {
    if (condition.f.size() < 2) return std::nullopt;
    Found found{0, 0, condition.p, condition.q, square_free(condition.f), first_bits, from, to};
    for (Weights* side : {&found.p, &found.q}) reduce(*side);
    for (; found.e <= most_bits; halve(found)) {
      if (!bracket(found)) return std::nullopt;
      if (settled(found)) return found;
    }
    return std::nullopt;
  }

  /// Without factors that all weights of a side have.
  static void reduce(Weights& side) {
    mpz_class content = 0;
    for (const auto& [v, weight] : side) {
      for (const mpz_class& c : weight) content = gcd(content, c);
    }
    if (content == 0) return;
    for (auto& [v, weight] : side) {
      for (mpz_class& c : weight) c /= content;
    }
  }

  /// Whether g changes its sign between l and u, which are made one if it is zero at either.
  static bool bracket(Found& found) {
    const int at_l = sign_at(found.g, found.l, found.e), at_u = sign_at(found.g, found.u, found.e);
    if (at_l == 0) found.u = found.l;
    if (at_l != 0 && at_u == 0) found.l = found.u;
    return at_l * at_u <= 0;
  }

  static void halve(Found& found) {
    if (found.l == found.u) {
      found.e = most_bits + 1;
      return;
    }
    const mpz_class middle = found.l + found.u;
    found.l *= 2;
    found.u *= 2;
    ++found.e;
    const int at_middle = sign_at(found.g, middle, found.e);
    (at_middle * sign_at(found.g, found.l, found.e) <= 0 ? found.u : found.l) = middle;
  }

  /// Whether all weights are seen to be as they have to be. If one vanishes at the root, g becomes what it has in
  /// common with it.
  static bool settled(Found& found) {
    bool all = true;
    for (const Weights* side : {&found.p, &found.q}) {
      Poly sum_of_weights;
      for (const auto& [v, weight] : *side) {
        all = not_negative(found, weight) && all;
        sum_of_weights = sum(sum_of_weights, weight);
      }
      all = all && least_sign(sum_of_weights, found.l, found.u, found.e) > 0;
    }
    return all;
  }

  static bool not_negative(Found& found, const Poly& weight) {
    if (divides(found.g, weight) || least_sign(weight, found.l, found.u, found.e) >= 0) return true;
    const Poly both = greatest_common_divisor(found.g, weight);
    if (both.size() < 2 || sign_at(both, found.l, found.e) * sign_at(both, found.u, found.e) > 0) return false;
    found.g = both;
    return true;
  }

  /// Cells that have the features, at rest at the end of the time's enclosure, and at some times of the step.
  std::optional<Found> at_some_time(const FeatureContact& contact, const std::vector<std::uint32_t>& of_p,
                                    const std::vector<std::uint32_t>& of_q) const {
    std::vector<mpz_class> times = {motion_.fraction(contact.first.begin, false),
                                    motion_.fraction(contact.first.end, true)};
    for (int i = 0; i <= 16; ++i) times.push_back(part_of_step(i / 16.0));
    for (const mpz_class& at : times) {
      for (const std::uint32_t i : of_p) {
        for (const std::uint32_t j : of_q) {
          if (i == j) continue;
          if (auto found = at_rest(i, j, at, first_bits)) return found;
        }
      }
    }
    return std::nullopt;
  }

  /// Whether two cells meet at a time: some vertices of theirs, none of them common, have just one way to do so.
  std::optional<Found> at_rest(std::uint32_t i, std::uint32_t j, const mpz_class& at, unsigned long e) const {
    const auto a = vertices_of(step_.mesh, i), b = vertices_of(step_.mesh, j);
    for (unsigned m = 1; m < 1U << a.size(); ++m) {
      for (unsigned n = 1; n < 1U << b.size(); ++n) {
        if (std::popcount(m) + std::popcount(n) > 5) continue;
        const std::vector<VertexId> p = chosen(a, m), q = chosen(b, n);
        if (std::ranges::find_first_of(p, q) != p.end()) continue;
        if (auto weights = weights_at(p, q, at, e)) {
          Found found{i, j, {}, {}, {-at, mpz_class(1) << e}, e, at, at};
          for (std::size_t k = 0; k < p.size(); ++k) found.p.push_back({p[k], trimmed({(*weights)[k]})});
          for (std::size_t k = 0; k < q.size(); ++k) found.q.push_back({q[k], trimmed({(*weights)[p.size() + k]})});
          return found;
        }
      }
    }
    return std::nullopt;
  }

  /// Weights with which p and q meet, if they are unique but for a factor, and none is negative.
  std::optional<std::vector<mpz_class>> weights_at(const std::vector<VertexId>& p, const std::vector<VertexId>& q,
                                                   const mpz_class& at, unsigned long e) const {
    const std::size_t n = p.size() + q.size();
    std::vector<std::vector<mpq_class>> rows(4, std::vector<mpq_class>(n));
    const auto vertices = FeatureSides{p, q}.both();
    const Segments segments(motion_, vertices, at, e);
    for (std::size_t c = 0; c < n; ++c) {
      const bool first = c < p.size();
      const auto x = segments.position_at(vertices[c], at, e);
      for (std::size_t k = 0; k < 3; ++k) rows[k][c] = first ? x[k] : mpz_class(-x[k]);
      rows[3][c] = first ? 1 : -1;
    }
    return kernel_of(rows, n);
  }

  /// The solution of rows . w = 0 if it has one dimension, w of one sign, in integers.
  static std::optional<std::vector<mpz_class>> kernel_of(std::vector<std::vector<mpq_class>> rows, std::size_t n) {
    std::vector<std::size_t> pivots;
    std::size_t free_column = n;
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t r = pivots.size();
      std::size_t best = r;
      while (best < rows.size() && rows[best][c] == 0) ++best;
      if (best >= rows.size()) {
        if (free_column != n) return std::nullopt;
        free_column = c;
        continue;
      }
      std::swap(rows[r], rows[best]);
      eliminate(rows, r, c);
      pivots.push_back(c);
    }
    if (free_column == n) return std::nullopt;
    std::vector<mpq_class> w(n, 0);
    w[free_column] = 1;
    for (std::size_t r = 0; r < pivots.size(); ++r) w[pivots[r]] = -rows[r][free_column];
    return integers(w);
  }

  /// Makes column c that of a unit matrix, with 1 in row r.
  static void eliminate(std::vector<std::vector<mpq_class>>& rows, std::size_t r, std::size_t c) {
    const mpq_class lead = rows[r][c];
    for (mpq_class& x : rows[r]) x /= lead;
    for (std::size_t other = 0; other < rows.size(); ++other) {
      const mpq_class factor = rows[other][c];
      if (other == r || factor == 0) continue;
      for (std::size_t k = 0; k < rows[r].size(); ++k) rows[other][k] -= factor * rows[r][k];
    }
  }

  static std::optional<std::vector<mpz_class>> integers(const std::vector<mpq_class>& w) {
    mpz_class denominator = 1;
    for (const mpq_class& x : w) {
      if (sgn(x) < 0) return std::nullopt;
      denominator = lcm(denominator, x.get_den());
    }
    std::vector<mpz_class> result;
    for (const mpq_class& x : w) result.push_back(x.get_num() * (denominator / x.get_den()));
    return result;
  }

  const WitnessStep& step_;
  IntegerMotion motion_;
};

std::optional<std::string> payload(const std::optional<Found>& found) {
  return found ? std::optional(encoded(*found)) : std::nullopt;
}

}  // namespace

std::optional<std::string> witness_of(const WitnessStep& step, const FeatureContact& contact) {
  return payload(Search(step).of_features(contact));
}

std::optional<std::string> witness_of(const WitnessStep& step, const InitialIntersection& pair) {
  return payload(Search(step).of_cells(pair.first_cell, pair.second_cell));
}

std::optional<std::string> witness_of(const WitnessStep& step, const TooNear& near, const MeshPaths& paths) {
  return payload(Search(step).of_near(near, paths));
}

std::optional<std::string> witness_of(const WitnessStep& step, const std::optional<FeatureContact>& first,
                                      std::span<const InitialIntersection> initial,
                                      std::span<const FeatureContact> contacts) {
  std::optional<std::string> witness;
  if (first) witness = witness_of(step, *first);
  for (std::size_t i = 0; i < initial.size() && !witness; ++i) witness = witness_of(step, initial[i]);
  for (std::size_t i = 0; i < contacts.size() && !witness; ++i) witness = witness_of(step, contacts[i]);
  return witness;
}

}  // namespace noli
