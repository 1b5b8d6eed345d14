// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/witness/witness.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <tuple>

#include "proofs/prover/tokens/tokens.h"
#include "proofs/prover/witness/dependency.h"
#include "proofs/prover/witness/integer_motion.h"
#include "proofs/prover/witness/roots.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/cell_features.h"

namespace noli {

namespace {

using namespace witness;

using Weights = std::vector<std::pair<VertexId, Polynomial>>;

struct Found {
  std::uint32_t i = 0, j = 0;
  Weights p, q;
  Polynomial g;
  Root time;
};

void put_polynomial(std::string& bytes, const Polynomial& f) {
  const auto size = static_cast<std::size_t>(f.degree()) + 1;
  put(bytes, static_cast<std::uint8_t>(std::max<std::size_t>(size, 1)));
  if (f.is_zero()) put_sint(bytes, Integer(0));
  for (std::size_t i = 0; i < size; ++i) put_sint(bytes, f[i]);
}

std::string encoded(const Found& found) {
  std::string bytes;
  put(bytes, found.i);
  put(bytes, found.j);
  for (const Weights* side : {&found.p, &found.q}) {
    put(bytes, static_cast<std::uint8_t>(side->size()));
    for (const auto& [v, weight] : *side) {
      put(bytes, v);
      put_polynomial(bytes, weight);
    }
  }
  put_polynomial(bytes, found.g);
  put_uint(bytes, found.time.e);
  put_sint(bytes, found.time.l);
  put_sint(bytes, found.time.u);
  return bytes;
}

using Sides = FeatureSides;

/// The two features of a contact.
Sides sides_of(const FeatureContact& contact) {
  const auto p = contact.vertices.begin(), q = p + first_size(contact.pair);
  return {{p, q}, {q, q + second_size(contact.pair)}};
}

/// 1: f is positive at the root of g, and after refining the root, none of its Bernstein coefficients on the enclosure
/// is negative; with `strictly`, all are positive. 0: f vanishes at the root. -1: as 1, for -f. Nothing if neither was
/// shown.
std::optional<int> sign_at_root(const Polynomial& f, const Polynomial& g, Root& root, bool strictly) {
  if (f.is_zero()) return 0;
  const Polynomial negative = Polynomial() - f;
  const auto seen = [&](int least) -> std::optional<int> {
    if (least_sign(f, root) >= least) return 1;
    if (least_sign(negative, root) >= least) return -1;
    return std::nullopt;
  };
  if (const auto sign = seen(1)) return sign;
  const Polynomial both = gcd(f, g);
  if (both.degree() > 0 && changes_sign(both, root)) return 0;
  for (;;) {
    if (const auto sign = seen(strictly ? 1 : 0)) return sign;
    if (!refine(g, root)) return std::nullopt;
    if (both.degree() > 0 && changes_sign(both, root)) return 0;
  }
}

/// Divides the weights of a side by their common integer factors; a single weight becomes 1.
void reduce(Weights& side) {
  if (side.size() == 1) side[0].second = distance::constant(Integer(1));
  Integer content;
  for (const auto& [v, weight] : side) mpz_gcd(content.get(), content.get(), weight.content().get());
  for (auto& [v, weight] : side) weight = quotient(std::move(weight), distance::constant(content));
}

class Search {
 public:
  explicit Search(const WitnessStep& step) : step_(step), motion_(step.lines, step.shift, step.dimension, step.eta) {}

  std::optional<std::string> of_features(const FeatureContact& contact) {
    const Sides sides = sides_of(contact);
    const auto of_p = cells_with(sides.p), of_q = cells_with(sides.q);
    if (!any_cells(of_p, of_q, [](auto, auto) { return true; })) return std::nullopt;
    const Integer begin = motion_.fraction(contact.first.begin, false), end = motion_.fraction(contact.first.end, true);
    if (!during(sides, begin, end) && !during(sides, part_of_step(0), part_of_step(1))) at_some_time(of_p, of_q);
    return std::move(payload_);
  }

  /// A witness at one time: the nearest points of some features of two cells that no short path joins.
  std::optional<std::string> of_near(const TooNear& near, const MeshPaths& paths) {
    const Integer at = part_of_step(near.time);
    cells_ = {near.first_cell, near.second_cell};
    const Sides whole{vertices_of(step_.mesh, near.first_cell), vertices_of(step_.mesh, near.second_cell)};
    for (Sides& s : parts_of(whole, whole.p.size() + whole.q.size())) {
      const bool swap = s.p.size() > s.q.size();
      if (swap) std::swap(s.p, s.q);
      const auto pair = pair_of(s);
      if (!pair || joined(s, paths)) continue;
      for (const std::size_t bits : {~std::size_t{0}, few_bits}) {
        auto found = near_at(*pair, s, at, bits);
        if (found && swap) std::swap(found->p, found->q);
        if (found && take(std::move(*found))) return std::move(payload_);
      }
    }
    return std::nullopt;
  }

  std::optional<std::string> of_cells(std::uint32_t i, std::uint32_t j) {
    cells_ = {i, j};
    at_rest({vertices_of(step_.mesh, i), vertices_of(step_.mesh, j)}, part_of_step(0));
    return std::move(payload_);
  }

 private:
  static constexpr std::size_t first_bits = IntegerMotion::first_bits;
  static constexpr std::size_t most_cells = 64;
  static constexpr std::size_t few_bits = 256;  ///< for weights that need not be exact

  /// Keeps the payload if it is a witness.
  bool take(Found found) {
    for (Weights* side : {&found.p, &found.q}) reduce(*side);
    found.i = cells_[0];
    found.j = cells_[1];
    std::string payload = encoded(found);
    if (fault_of_witness(step_, payload)) return false;
    payload_ = std::move(payload);
    return true;
  }

  bool compared(std::uint32_t i, std::uint32_t j) const { return (i != j || step_.strict) && step_.compares(i, j); }

  /// Calls take(i, j) for each pair of compared cells until it returns true; returns whether it did.
  template <class Take>
  bool any_cells(const std::vector<std::uint32_t>& of_p, const std::vector<std::uint32_t>& of_q, const Take& take) {
    for (const std::uint32_t i : of_p) {
      for (const std::uint32_t j : of_q) {
        if (!compared(i, j)) continue;
        cells_ = {i, j};
        if (take(i, j)) return true;
      }
    }
    return false;
  }

  /// A witness if the nearest points of the features' planes and lines are in the features, and near enough. Weights
  /// are cut to `bits` bits.
  std::optional<Found> near_at(FeaturePair pair, const Sides& s, const Integer& at, std::size_t bits) const {
    const Segments segments(motion_, s.both(), at, first_bits);
    const auto place = [&](VertexId v) {
      PolynomialPosition x;
      const auto numbers = segments.position_at(v, at, first_bits);
      for (std::size_t k = 0; k < 3; ++k) x[k] = distance::constant(numbers[k]);
      return x;
    };
    Found found;
    std::tie(found.p, found.q) = nearest(pair, s, place);
    found.g = Polynomial({-at, Integer(1) << first_bits});
    found.time = {at, at, first_bits};
    Integer square, total_p, total_q;
    std::array<Integer, 3> x, y;
    for (Weights* side : {&found.p, &found.q}) cut(*side, bits);
    if (!add_up(segments, found.p, at, total_p, x) || !add_up(segments, found.q, at, total_q, y)) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
      const Integer d = total_q * x[k] - total_p * y[k];
      square += d * d;
    }
    const Integer least = (segments.scale() * motion_.length(step_.eta) << first_bits) * total_p * total_q;
    return square <= least * least ? std::optional(found) : std::nullopt;
  }

  static Integer constant_of(const Polynomial& weight) { return weight.is_zero() ? Integer() : weight[0]; }

  /// Shifts constant weights so that the largest has at most `bits` bits.
  static void cut(Weights& side, std::size_t bits) {
    std::size_t most = 0;
    for (const auto& [v, w] : side) most = std::max(most, constant_of(w).bit_length());
    if (most <= bits) return;
    for (auto& [v, w] : side) w = distance::constant(constant_of(w) >>= most - bits);
  }

  /// The sums of constant weights, and of weights times positions. False if a weight is negative or all are 0.
  static bool add_up(const Segments& segments, const Weights& side, const Integer& at, Integer& total,
                     std::array<Integer, 3>& x) {
    for (const auto& [v, weight] : side) {
      const Integer w = constant_of(weight);
      if (w.sign() < 0) return false;
      total += w;
      const auto position = segments.position_at(v, at, first_bits);
      for (std::size_t k = 0; k < 3; ++k) x[k] += w * position[k];
    }
    return total.sign() > 0;
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

  /// The weights of the nearest points of the features' planes and lines: the `inside` of kernel/distance_parts.h. `at`
  /// gives the position of a vertex.
  template <class At>
  static std::pair<Weights, Weights> nearest(FeaturePair pair, const Sides& s, const At& at) {
    const Polynomial one = distance::constant(Integer(1));
    const auto &p = s.p, &q = s.q;
    distance::Parts<3> parts{Integer()};
    const auto inside = [&](std::size_t i) { return parts.parts().front().inside[i]; };
    switch (pair) {
      case FeaturePair::vertex_face:
        parts.vertex_face(at(p[0]), at(q[0]), at(q[1]), at(q[2]));
        return {{{p[0], one}}, {{q[0], inside(1)}, {q[1], inside(2)}, {q[2], inside(0)}}};
      case FeaturePair::edge_edge:
        parts.edge_edge(at(p[0]), at(p[1]), at(q[0]), at(q[1]));
        return {{{p[0], inside(1)}, {p[1], inside(0)}}, {{q[0], inside(3)}, {q[1], inside(2)}}};
      case FeaturePair::vertex_edge:
        parts.vertex_edge(at(p[0]), at(q[0]), at(q[1]));
        return {{{p[0], one}}, {{q[0], inside(1)}, {q[1], inside(0)}}};
      case FeaturePair::vertex_vertex: break;
    }
    return {{{p[0], one}}, {{q[0], one}}};
  }

  Integer begin() const { return motion_.time(step_.lines.first_time()); }
  /// T0 plus this share of the step, rounded down to a multiple of 2^-first_bits; times 2^first_bits.
  Integer part_of_step(double part) const {
    const Dyadic whole{(motion_.time(step_.lines.last_time()) - begin()) << first_bits, 0};
    return IntegerMotion::rounded_down(Dyadic::from_double(part) * whole) + (begin() << first_bits);
  }

  /// Looks for a witness between two times: in order, in each of the parts into which breakpoints cut the interval.
  bool during(const Sides& sides, Integer from, const Integer& end) {
    const auto vertices = sides.both();
    if (is_whole(from) && at_rest(sides, from)) return true;
    for (const Integer& to : breakpoints_between(vertices, from, end)) {
      if (from < to && at_roots(sides, from, to)) return true;
      if (is_whole(to) && at_rest(sides, to)) return true;
      from = to;
    }
    return !is_whole(end) && at_rest(sides, end);
  }

  /// Breakpoints are at whole numbers of integer time.
  static bool is_whole(const Integer& at) { return at.is_zero() || trailing_zeros(at) >= first_bits; }

  /// The breakpoints between two times, and the second time.
  std::vector<Integer> breakpoints_between(const std::vector<VertexId>& vertices, const Integer& from,
                                           const Integer& to) const {
    std::set<Integer> cuts = {to};
    for (const VertexId v : vertices) {
      const auto times = step_.lines.times(v);
      const auto time = [&](double t) { return motion_.time(t) << first_bits; };
      auto t = std::partition_point(times.begin(), times.end(), [&](double b) { return time(b) <= from; });
      for (; t != times.end() && time(*t) < to; ++t) cuts.insert(time(*t));
    }
    return {cuts.begin(), cuts.end()};
  }

  /// Looks for a witness at a time between two breakpoints at which some vertices of both features meet.
  bool at_roots(const Sides& sides, const Integer& from, const Integer& to) {
    const Segments segments(motion_, sides.both(), from, first_bits);
    return any_dependency(
        sides, [&](VertexId v) { return segments.position(v); },
        [&](Dependency d) {
          if (d.condition.degree() < 1) return false;
          divide(d);
          Polynomial g = square_free_part(d.condition.primitive());
          for (const Integer& end : {from, to}) g = without_breakpoint(std::move(g), end);
          if (g.degree() < 1) return false;
          const auto roots = roots_within(g, from, to, first_bits);
          return std::ranges::any_of(roots, [&](const Root& root) {
            return at_root(d, g, root) || (g.degree() == 1 && at_fraction(d, g, root));
          });
        });
  }

  /// Divides by the common factor of all weights: near a time at which they vanish together, their sum could not be
  /// shown to be positive.
  static void divide(Dependency& d) {
    Polynomial common;
    for (const Polynomial& weight : d.weights) common = gcd(common, weight);
    if (common.degree() < 1) return;
    for (Polynomial& weight : d.weights) weight = quotient(std::move(weight), common);
    d.condition = quotient(std::move(d.condition), common);
  }

  /// Removes the root at a breakpoint: features that meet there are handled at rest.
  static Polynomial without_breakpoint(Polynomial g, const Integer& at) {
    if (!is_whole(at) || g.sign_at({at, first_bits}) != 0) return g;
    return quotient(std::move(g), Polynomial({-at >>= first_bits, Integer(1)}));
  }

  /// Tries the weights at the root of g = a t - b as constants; this works however near other roots are.
  bool at_fraction(const Dependency& d, const Polynomial& g, const Root& root) {
    const Integer b = -g[0];
    const Integer& a = g[1];
    Dependency constant = d;
    int degree = 0;
    for (const Polynomial& weight : d.weights) degree = std::max(degree, weight.degree());
    for (Polynomial& weight : constant.weights) {
      Integer value, power(1);
      for (int k = degree; k >= 0; --k) {
        value *= b;
        if (k <= weight.degree()) value += weight[static_cast<std::size_t>(k)] * power;
        power *= a;
      }
      weight = distance::constant(value);
    }
    return at_root(constant, g, root);
  }

  /// Looks for a witness at a root: the weights must have one sign there. If a weight vanishes, g is replaced by its
  /// gcd with that weight.
  bool at_root(const Dependency& d, Polynomial g, Root root) {
    int sign = 0;
    Found found;
    for (std::size_t i = 0; i < d.weights.size(); ++i) {
      const auto at_root = sign_at_root(d.weights[i], g, root, false);
      if (!at_root || *at_root * sign < 0) return false;
      if (*at_root != 0) sign = *at_root;
      if (*at_root == 0) g = gcd(g, d.weights[i]);
      const bool first = i < d.sides.p.size();
      const VertexId v = first ? d.sides.p[i] : d.sides.q[i - d.sides.p.size()];
      (first ? found.p : found.q).emplace_back(v, d.weights[i]);
    }
    for (Weights* side : {&found.p, &found.q}) {
      Polynomial total;
      for (auto& [v, weight] : *side) {
        if (sign < 0) weight = Polynomial() - weight;
        total += weight;
      }
      if (sign_at_root(total, g, root, true) != 1) return false;
    }
    found.g = std::move(g);
    found.time = std::move(root);
    return take(std::move(found));
  }

  /// Tries the cells that have the features, at rest at some times of the step.
  void at_some_time(const std::vector<std::uint32_t>& of_p, const std::vector<std::uint32_t>& of_q) {
    bool found = false;
    for (int k = 0; k <= 16 && !found; ++k) {
      const Integer at = part_of_step(k / 16.0);
      found = any_cells(of_p, of_q, [&](std::uint32_t i, std::uint32_t j) {
        return i != j && at_rest({vertices_of(step_.mesh, i), vertices_of(step_.mesh, j)}, at);
      });
    }
  }

  /// Looks for a witness at one time: a subset of the vertices of two sides that meets with unique weights.
  bool at_rest(const Sides& sides, const Integer& at) {
    // Few bits of time make weights short.
    const std::size_t excess = at.is_zero() ? first_bits : std::min(first_bits, trailing_zeros(at));
    const Integer time = Integer(at) >>= excess;
    const std::size_t e = first_bits - excess;
    return std::ranges::any_of(parts_of(sides, 5), [&](const Sides& part) {
      const auto weights = weights_at(part.p, part.q, time, e);
      if (!weights) return false;
      Found found{0, 0, {}, {}, Polynomial({-time, Integer(1) << e}), {time, time, e}};
      auto weight = weights->begin();
      for (const VertexId v : part.p) found.p.emplace_back(v, distance::constant(*weight++));
      for (const VertexId v : part.q) found.q.emplace_back(v, distance::constant(*weight++));
      return take(std::move(found));
    });
  }

  /// Weights with which p and q meet, if they are unique up to a factor, and none is negative.
  std::optional<std::vector<Integer>> weights_at(const std::vector<VertexId>& p, const std::vector<VertexId>& q,
                                                 const Integer& at, std::size_t e) const {
    const std::size_t n = p.size() + q.size();
    std::vector<std::vector<mpq_class>> rows(4, std::vector<mpq_class>(n));
    const auto vertices = FeatureSides{p, q}.both();
    const Segments segments(motion_, vertices, at, e);
    for (std::size_t c = 0; c < n; ++c) {
      const bool first = c < p.size();
      const auto x = segments.position_at(vertices[c], at, e);
      for (std::size_t k = 0; k < 3; ++k) rows[k][c] = mpz_class((first ? x[k] : -x[k]).get());
      rows[3][c] = first ? 1 : -1;
    }
    return kernel_of(rows, n);
  }

  /// The solution of rows . w = 0 if it has one dimension, w of one sign, in integers.
  static std::optional<std::vector<Integer>> kernel_of(std::vector<std::vector<mpq_class>> rows, std::size_t n) {
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

  static std::optional<std::vector<Integer>> integers(const std::vector<mpq_class>& w) {
    mpz_class denominator = 1;
    for (const mpq_class& x : w) {
      if (sgn(x) < 0) return std::nullopt;
      denominator = lcm(denominator, x.get_den());
    }
    std::vector<Integer> result(w.size());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const mpz_class number = w[i].get_num() * (denominator / w[i].get_den());
      mpz_set(result[i].get(), number.get_mpz_t());
    }
    return result;
  }

  const WitnessStep& step_;
  IntegerMotion motion_;
  std::array<std::uint32_t, 2> cells_{};  ///< the cells that the witness names
  std::optional<std::string> payload_;
};

}  // namespace

std::optional<std::string> witness_of(const WitnessStep& step, const FeatureContact& contact) {
  return Search(step).of_features(contact);
}

std::optional<std::string> witness_of(const WitnessStep& step, const InitialIntersection& pair) {
  return Search(step).of_cells(pair.first_cell, pair.second_cell);
}

std::optional<std::string> witness_of(const WitnessStep& step, const TooNear& near, const MeshPaths& paths) {
  return Search(step).of_near(near, paths);
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
