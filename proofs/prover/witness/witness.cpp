// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/witness/witness.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <tuple>

#include "proofs/prover/cells/features.h"
#include "proofs/prover/tokens/tokens.h"
#include "proofs/prover/witness/dependency.h"
#include "proofs/prover/witness/roots.h"
#include "proofs/prover/witness/witness_judge.h"
#include "trajectory/blocks/bytes.h"

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

/// 1: f is positive at the root of g, and none of its Bernstein coefficients is negative on the enclosure that is left
/// of it; `strictly`: all of them are positive. 0: f vanishes there; -1: as for 1, with -f; nothing if that is not
/// seen.
std::optional<int> sign_at_root(const Poly& f, const Poly& g, Root& root, bool strictly) {
  if (f.empty()) return 0;
  const Poly negative = difference({}, f);
  const auto seen = [&](int least) -> std::optional<int> {
    if (least_sign(f, root.l, root.u, root.e) >= least) return 1;
    if (least_sign(negative, root.l, root.u, root.e) >= least) return -1;
    return std::nullopt;
  };
  if (const auto sign = seen(1)) return sign;
  const Poly both = greatest_common_divisor(f, g);
  if (both.size() > 1 && changes_sign(both, root)) return 0;
  for (;;) {
    if (const auto sign = seen(strictly ? 1 : 0)) return sign;
    if (!refine(g, root)) return std::nullopt;
    if (both.size() > 1 && changes_sign(both, root)) return 0;
  }
}

/// Without factors that all weights of a side have; a single one is 1.
void reduce(Weights& side) {
  if (side.size() == 1) side[0].second = {1};
  mpz_class content = 0;
  for (const auto& [v, weight] : side) {
    for (const mpz_class& c : weight) content = gcd(content, c);
  }
  for (auto& [v, weight] : side) {
    for (mpz_class& c : weight) c /= content;
  }
}

class Search {
 public:
  explicit Search(const WitnessStep& step) : step_(step), motion_(step.lines, step.shift, step.dimension, step.eta) {}

  std::optional<std::string> of_features(const FeatureContact& contact) {
    const Sides sides = sides_of(contact);
    const auto of_p = cells_with(sides.p), of_q = cells_with(sides.q);
    if (!choose_cells(of_p, of_q)) return std::nullopt;
    const mpz_class begin = motion_.fraction(contact.first.begin, false),
                    end = motion_.fraction(contact.first.end, true);
    if (!during(sides, begin, end) && !during(sides, part_of_step(0), part_of_step(1))) at_some_time(of_p, of_q);
    return std::move(payload_);
  }

  /// At a time, the nearest points of some features of two cells that no short path joins.
  std::optional<std::string> of_near(const TooNear& near, const MeshPaths& paths) {
    const mpz_class at = part_of_step(near.time);
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
  static constexpr unsigned long first_bits = IntegerMotion::first_bits;
  static constexpr std::size_t most_cells = 64;
  static constexpr std::size_t few_bits = 256;  ///< of weights that need not be exact

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

  bool choose_cells(const std::vector<std::uint32_t>& of_p, const std::vector<std::uint32_t>& of_q) {
    for (const std::uint32_t i : of_p) {
      for (const std::uint32_t j : of_q) {
        if (!compared(i, j)) continue;
        cells_ = {i, j};
        return true;
      }
    }
    return false;
  }

  /// If the nearest points of the features' planes and lines are in the features, and near enough. Weights are cut to
  /// so many bits.
  std::optional<Found> near_at(FeaturePair pair, const Sides& s, const mpz_class& at, std::size_t bits) const {
    const Segments segments(motion_, s.both(), at, first_bits);
    const auto place = [&](VertexId v) {
      PolyVector x;
      const auto numbers = segments.position_at(v, at, first_bits);
      for (std::size_t k = 0; k < 3; ++k) x[k] = trimmed({numbers[k]});
      return x;
    };
    Found found;
    std::tie(found.p, found.q) = nearest(pair, s, place);
    found.g = {-at, mpz_class(1) << first_bits};
    found.e = first_bits;
    found.l = found.u = at;
    mpz_class square = 0, total_p = 0, total_q = 0;
    std::array<mpz_class, 3> x{}, y{};
    for (Weights* side : {&found.p, &found.q}) cut(*side, bits);
    if (!add_up(segments, found.p, at, total_p, x) || !add_up(segments, found.q, at, total_q, y)) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
      const mpz_class d = total_q * x[k] - total_p * y[k];
      square += d * d;
    }
    const mpz_class least = (segments.scale() * motion_.length(step_.eta) << first_bits) * total_p * total_q;
    return square <= least * least ? std::optional(found) : std::nullopt;
  }

  /// Leaves so many bits of the largest of some constant weights.
  static void cut(Weights& side, std::size_t bits) {
    std::size_t most = 0;
    for (const auto& [v, w] : side) most = std::max(most, w.empty() ? 0 : mpz_sizeinbase(w[0].get_mpz_t(), 2));
    if (most <= bits) return;
    for (auto& [v, w] : side) {
      if (!w.empty()) w = trimmed({mpz_class(w[0] >> (most - bits))});
    }
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

  /// The weights of the nearest points of the features' planes and lines. `at` gives the position of a vertex.
  template <class At>
  static std::pair<Weights, Weights> nearest(FeaturePair pair, const Sides& s, const At& at) {
    if (pair == FeaturePair::vertex_face) return vertex_face(s, at);
    if (pair == FeaturePair::edge_edge) return edge_edge(s, at);
    if (pair == FeaturePair::vertex_edge) return vertex_edge(s, at);
    return {{{s.p[0], {1}}}, {{s.q[0], {1}}}};
  }

  template <class At>
  static std::pair<Weights, Weights> vertex_face(const Sides& s, const At& at) {
    const PolyVector x = at(s.p[0]);
    const std::array<PolyVector, 3> corner = {at(s.q[0]), at(s.q[1]), at(s.q[2])};
    const PolyVector n = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    Weights q;
    for (std::size_t i = 0; i < 3; ++i) {
      q.emplace_back(s.q[i], inner(n, cross(minus(corner[(i + 1) % 3], x), minus(corner[(i + 2) % 3], x))));
    }
    return {{{s.p[0], {1}}}, std::move(q)};
  }

  template <class At>
  static std::pair<Weights, Weights> edge_edge(const Sides& s, const At& at) {
    const PolyVector a = at(s.p[0]), c = at(s.q[0]);
    const PolyVector u = minus(at(s.p[1]), a), v = minus(at(s.q[1]), c), r = minus(c, a);
    const PolyVector n = cross(u, v);
    const Poly all = inner(n, n), along_u = inner(cross(r, v), n), along_v = inner(cross(r, u), n);
    return {{{s.p[0], difference(all, along_u)}, {s.p[1], along_u}},
            {{s.q[0], difference(all, along_v)}, {s.q[1], along_v}}};
  }

  template <class At>
  static std::pair<Weights, Weights> vertex_edge(const Sides& s, const At& at) {
    const PolyVector a = at(s.q[0]), u = minus(at(s.q[1]), a), r = minus(at(s.p[0]), a);
    const Poly all = inner(u, u), along = inner(r, u);
    return {{{s.p[0], {1}}}, {{s.q[0], difference(all, along)}, {s.q[1], along}}};
  }

  mpz_class begin() const { return motion_.time(step_.lines.first_time()); }
  /// T0 and so much of the step, rounded down to a multiple of 2^-first_bits; times 2^first_bits.
  mpz_class part_of_step(double part) const {
    mpq_class at(part);
    at *= (motion_.time(step_.lines.last_time()) - begin()) << first_bits;
    mpz_class result;
    mpz_fdiv_q(result.get_mpz_t(), at.get_num_mpz_t(), at.get_den_mpz_t());
    return result + (begin() << first_bits);
  }

  /// Looks for a witness between two times, in one after another of the parts into which breakpoints cut that.
  bool during(const Sides& sides, mpz_class from, const mpz_class& end) {
    const auto vertices = sides.both();
    if (is_whole(from) && at_rest(sides, from)) return true;
    for (const mpz_class& to : breakpoints_between(vertices, from, end)) {
      if (from < to && at_roots(sides, from, to)) return true;
      if (is_whole(to) && at_rest(sides, to)) return true;
      from = to;
    }
    return !is_whole(end) && at_rest(sides, end);
  }

  /// Breakpoints are at whole numbers of integer time.
  static bool is_whole(const mpz_class& at) { return at == 0 || mpz_scan1(at.get_mpz_t(), 0) >= first_bits; }

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

  /// At a time between two breakpoints at which some vertices of both features meet.
  bool at_roots(const Sides& sides, const mpz_class& from, const mpz_class& to) {
    const Segments segments(motion_, sides.both(), from, first_bits);
    return any_dependency(
        sides, [&](VertexId v) { return segments.position(v); },
        [&](Dependency d) {
          if (d.condition.size() < 2) return false;
          divide(d);
          Poly g = square_free(d.condition);
          for (const mpz_class& end : {from, to}) g = without_breakpoint(std::move(g), end);
          if (g.size() < 2) return false;
          const auto roots = roots_within(g, from, to, first_bits);
          return std::ranges::any_of(roots, [&](const Root& root) {
            return at_root(d, g, root) || (g.size() == 2 && at_fraction(d, g, root));
          });
        });
  }

  /// By what all of its weights have in common: near a time at which they vanish together, their sum would not be seen
  /// to be positive.
  static void divide(Dependency& d) {
    Poly common;
    for (const Poly& weight : d.weights) common = greatest_common_divisor(common, weight);
    if (common.size() < 2) return;
    for (Poly& weight : d.weights) weight = quotient(std::move(weight), common);
    d.condition = quotient(std::move(d.condition), common);
  }

  /// What meets at a breakpoint does so at rest.
  static Poly without_breakpoint(Poly g, const mpz_class& at) {
    if (!is_whole(at) || sign_at(g, at, first_bits) != 0) return g;
    return quotient(std::move(g), {mpz_class(-at >> first_bits), 1});
  }

  /// With the weights at the root of a t - b, as constants: however near other roots are.
  bool at_fraction(const Dependency& d, const Poly& g, const Root& root) {
    const mpz_class b = -g[0], a = g[1];
    Dependency constant = d;
    for (Poly& weight : constant.weights) {
      mpz_class value = 0, power = 1;
      for (std::size_t k = d.degree() + 1; k-- > 0; power *= a) {
        value *= b;
        if (k < weight.size()) value += weight[k] * power;
      }
      weight = trimmed({value});
    }
    return at_root(constant, g, root);
  }

  /// Whether the weights are of one sign there. Where one vanishes, g becomes what it has in common with it.
  bool at_root(const Dependency& d, Poly g, Root root) {
    int sign = 0;
    Found found;
    for (std::size_t i = 0; i < d.weights.size(); ++i) {
      const auto at_root = sign_at_root(d.weights[i], g, root, false);
      if (!at_root || *at_root * sign < 0) return false;
      if (*at_root != 0) sign = *at_root;
      if (*at_root == 0) g = greatest_common_divisor(g, d.weights[i]);
      const bool first = i < d.sides.p.size();
      const VertexId v = first ? d.sides.p[i] : d.sides.q[i - d.sides.p.size()];
      (first ? found.p : found.q).emplace_back(v, d.weights[i]);
    }
    for (Weights* side : {&found.p, &found.q}) {
      Poly total;
      for (auto& [v, weight] : *side) {
        if (sign < 0) weight = difference({}, weight);
        total = sum(total, weight);
      }
      if (sign_at_root(total, g, root, true) != 1) return false;
    }
    found.g = std::move(g);
    found.e = root.e;
    found.l = root.l;
    found.u = root.u;
    return take(std::move(found));
  }

  /// Cells that have the features, at rest at some times of the step.
  bool at_some_time(const std::vector<std::uint32_t>& of_p, const std::vector<std::uint32_t>& of_q) {
    for (int k = 0; k <= 16; ++k) {
      const mpz_class at = part_of_step(k / 16.0);
      for (const std::uint32_t i : of_p) {
        for (const std::uint32_t j : of_q) {
          if (i == j || !compared(i, j)) continue;
          cells_ = {i, j};
          if (at_rest({vertices_of(step_.mesh, i), vertices_of(step_.mesh, j)}, at)) return true;
        }
      }
    }
    return false;
  }

  /// Whether two sides meet at a time: some of their vertices have just one way to do so.
  bool at_rest(const Sides& sides, const mpz_class& at) {
    // Few bits of time make weights short.
    const unsigned long excess = at == 0 ? first_bits : std::min(first_bits, mpz_scan1(at.get_mpz_t(), 0));
    const mpz_class time = at >> excess;
    const unsigned long e = first_bits - excess;
    return std::ranges::any_of(parts_of(sides, 5), [&](const Sides& part) {
      const auto weights = weights_at(part.p, part.q, time, e);
      if (!weights) return false;
      Found found{0, 0, {}, {}, {-time, mpz_class(1) << e}, e, time, time};
      for (std::size_t k = 0; k < part.p.size(); ++k) found.p.emplace_back(part.p[k], trimmed({(*weights)[k]}));
      for (std::size_t k = 0; k < part.q.size(); ++k)
        found.q.emplace_back(part.q[k], trimmed({(*weights)[part.p.size() + k]}));
      return take(std::move(found));
    });
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
  std::array<std::uint32_t, 2> cells_{};  ///< which the witness names
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
