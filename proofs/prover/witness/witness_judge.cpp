// SPDX-License-Identifier: Apache-2.0
//
// Judges witnesses. It starts from the bytes and shares no arithmetic with the search (witness.cpp): it has rational
// numbers instead of integers, and polynomials of its own.
#include "proofs/prover/witness/witness.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <vector>

#include "kernel/arithmetic/scaled_integers.h"
#include "trajectory/cell_features.h"

namespace noli {

namespace {

/// Why a witness is rejected.
struct Fault {
  const char* reason;
};

void require(bool holds, const char* otherwise) {
  if (!holds) throw Fault{otherwise};
}

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(take(1)[0]); }
  std::uint32_t u32() {
    std::uint32_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  mpz_class uint(std::size_t most_bytes) {
    mpz_class value = 0;
    for (std::size_t n = 0;; ++n) {
      require(n < most_bytes, "an integer is too long");
      const unsigned byte = u8();
      require(n == 0 || byte != 0, "an integer is written longer than it is");
      value += mpz_class(byte & 0x7f) << 7 * n;
      if (byte < 0x80) return value;
    }
  }
  mpz_class sint() {
    const mpz_class coded = uint(1200);
    const mpz_class half = coded >> 1;
    return mpz_odd_p(coded.get_mpz_t()) != 0 ? mpz_class(-half - 1) : half;
  }
  void end() const { require(bytes_.empty(), "bytes are left"); }

 private:
  std::string_view take(std::size_t count) {
    require(count <= bytes_.size(), "bytes are missing");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

/// Coefficients, the constant term first; the last one is not 0.
using Rational = std::vector<mpq_class>;

Rational without_zeros(Rational f) {
  while (!f.empty() && sgn(f.back()) == 0) f.pop_back();
  return f;
}

Rational add(Rational f, const Rational& g, const mpq_class& times = 1) {
  f.resize(std::max(f.size(), g.size()));
  for (std::size_t i = 0; i < g.size(); ++i) f[i] += times * g[i];
  return without_zeros(std::move(f));
}

Rational multiply(const Rational& f, const Rational& g) {
  if (f.empty() || g.empty()) return {};
  Rational product(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < g.size(); ++j) product[i + j] += f[i] * g[j];
  }
  return product;
}

mpq_class value_at(const Rational& f, const mpq_class& t) {
  mpq_class value = 0;
  for (std::size_t i = f.size(); i-- > 0;) value = value * t + f[i];
  return value;
}

/// Whether g, which is not 0, divides f.
bool is_multiple(Rational f, const Rational& g) {
  while (f.size() >= g.size()) {
    const mpq_class factor = f.back() / g.back();
    const std::size_t shift = f.size() - g.size();
    for (std::size_t i = 0; i < g.size(); ++i) f[shift + i] -= factor * g[i];
    f.pop_back();
    f = without_zeros(std::move(f));
  }
  return f.empty();
}

mpq_class binomial(std::size_t n, std::size_t k) {
  mpz_class value;
  mpz_bin_uiui(value.get_mpz_t(), n, k);
  return value;
}

/// f(l + (u - l) z) = sum a_k z^k has the Bernstein coefficients b_i = sum_k binomial(i, k) / binomial(n, k) a_k.
std::vector<mpq_class> bernstein_coefficients(const Rational& f, const mpq_class& l, const mpq_class& u) {
  Rational a;
  for (std::size_t i = f.size(); i-- > 0;) {
    Rational next(a.size() + 1);
    for (std::size_t k = 0; k < a.size(); ++k) {
      next[k] += a[k] * l;
      next[k + 1] += a[k] * (u - l);
    }
    next[0] += f[i];
    if (next.size() > f.size()) next.pop_back();
    a = std::move(next);
  }
  std::vector<mpq_class> b(f.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t k = 0; k <= i; ++k) b[i] += binomial(i, k) / binomial(f.size() - 1, k) * a[k];
  }
  return b;
}

struct Corner {
  VertexId v;
  Rational weight;
};

/// The sum of weight times position, and the sum of the weights.
struct Centre {
  std::array<Rational, 3> x;
  Rational weight;
};

class Judge {
 public:
  Judge(const WitnessStep& step, std::string_view payload) : step_(step), bytes_(payload) {
    exact::ExponentRange units;
    for (VertexId v = 0; v < step.lines.vertex_count(); ++v) {
      for (const double t : step.lines.times(v)) units.add(t + step.shift);
    }
    time_unit_ = units.high < units.low ? 0 : units.low;
  }

  void judge() {
    const std::uint32_t i = bytes_.u32(), j = bytes_.u32();
    require(std::max(i, j) < step_.mesh.cell_count(), "no such cell");
    p_ = side_of(i);
    q_ = side_of(j);
    const std::uint8_t degree_and_1 = read_poly(g_);
    const mpz_class e = bytes_.uint(10);
    require(e <= 8192, "e is above 8,192");
    const mpz_class one = mpz_class(1) << e.get_ui();
    l_ = mpq_class(bytes_.sint(), one);
    u_ = mpq_class(bytes_.sint(), one);
    l_.canonicalize();
    u_.canonicalize();
    bytes_.end();
    require(g_.size() == degree_and_1, "the last coefficient of g is 0");
    require_two_sides(i, j);
    require_time();
    require_meeting(centre_of(p_), centre_of(q_));
  }

 private:
  using Side = std::vector<Corner>;

  std::uint8_t read_poly(Rational& f) {
    const std::uint8_t count = bytes_.u8();
    require(count >= 1 && count <= 32, "a polynomial has 1 to 32 coefficients");
    for (std::uint8_t k = 0; k < count; ++k) f.emplace_back(bytes_.sint());
    f = without_zeros(std::move(f));
    return count;
  }

  Side side_of(std::uint32_t cell) {
    const std::uint8_t count = bytes_.u8();
    require(count >= 1 && count <= 3, "a side has 1 to 3 vertices");
    Side side(count);
    for (auto& [v, weight] : side) {
      v = bytes_.u32();
      require(has(cell, v), "a vertex is not one of its cell");
      read_poly(weight);
    }
    return side;
  }

  bool has(std::uint32_t cell, VertexId v) const {
    const auto of_cell = corners(step_.mesh, cell);
    return std::ranges::find(of_cell, v) != of_cell.end();
  }

  void require_two_sides(std::uint32_t i, std::uint32_t j) const {
    require(i != j || step_.strict, "it is about one cell");
    require(step_.compares(i, j), "the pair is excluded");
    for (const Corner& corner : p_) {
      require(std::ranges::find(q_, corner.v, &Corner::v) == q_.end(), "a vertex is on both sides");
    }
  }

  /// The time of a breakpoint, in integer time.
  mpq_class time(double t) const {
    mpq_class exact(t + step_.shift);
    if (time_unit_ >= 0) {
      exact /= mpz_class(1) << static_cast<unsigned long>(time_unit_);
    } else {
      exact *= mpz_class(1) << static_cast<unsigned long>(-time_unit_);
    }
    return exact;
  }

  void require_time() const {
    require(time(step_.lines.first_time()) <= l_ && l_ <= u_ && u_ <= time(step_.lines.last_time()),
            "the time is not in the step");
    require(sgn(value_at(g_, l_)) * sgn(value_at(g_, u_)) <= 0, "g does not change its sign");
  }

  std::array<Rational, 3> position(VertexId v) const {
    const auto times = step_.lines.times(v);
    const auto places = step_.lines.positions(v);
    const auto next = std::ranges::partition_point(times, [&](double t) { return time(t) <= l_; });
    const auto k = static_cast<std::size_t>(next - times.begin());
    std::array<Rational, 3> x;
    require(next != times.end() || u_ == l_, "the enclosure goes on behind the last breakpoint");
    require(next == times.end() || u_ <= time(*next), "a vertex has a breakpoint in the enclosure");
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(step_.dimension); ++axis) {
      const mpq_class a(places[k - 1][axis]);
      if (next == times.end()) {
        x[axis] = without_zeros({a});
        continue;
      }
      const mpq_class s = time(times[k - 1]), t = time(*next), b(places[k][axis]);
      const mpq_class duration = t - s;
      x[axis] = without_zeros({(a * t - b * s) / duration, (b - a) / duration});
    }
    return x;
  }

  bool not_negative(const Rational& f) const {
    return is_multiple(f, g_) || std::ranges::min(bernstein_coefficients(f, l_, u_)) >= 0;
  }
  bool is_positive(const Rational& f) const {
    return !f.empty() && std::ranges::min(bernstein_coefficients(f, l_, u_)) > 0;
  }

  Centre centre_of(const Side& side) const {
    Centre centre;
    for (const auto& [v, weight] : side) {
      require(not_negative(weight), "a weight may be negative");
      centre.weight = add(std::move(centre.weight), weight);
      const auto x = position(v);
      for (std::size_t k = 0; k < 3; ++k) centre.x[k] = add(std::move(centre.x[k]), multiply(weight, x[k]));
    }
    require(is_positive(centre.weight), "a sum of weights may not be positive");
    return centre;
  }

  void require_meeting(const Centre& p, const Centre& q) const {
    bool meet = true;
    Rational square;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational d = add(multiply(q.weight, p.x[k]), multiply(p.weight, q.x[k]), -1);
      meet = meet && is_multiple(d, g_);
      square = add(std::move(square), multiply(d, d));
    }
    if (meet) return;
    require(step_.eta > 0, "the points do not meet");
    require(!joined(), "the points do not meet, and a short path joins the sides");
    const Rational weights = multiply(p.weight, q.weight);
    const mpq_class eta(step_.eta);
    require(not_negative(add(multiply({eta * eta}, multiply(weights, weights)), square, -1)),
            "the points are not as near as the least distance");
  }

  /// Whether a path of fewer than K edges joins a vertex of P to one of Q.
  bool joined() const {
    std::set<VertexId> reached;
    for (const Corner& corner : p_) reached.insert(corner.v);
    for (std::uint32_t k = 1; k < step_.ring; ++k) {
      const std::set<VertexId> before = reached;
      for (std::uint32_t c = 0; c < step_.mesh.cell_count(); ++c) {
        const auto of_cell = corners(step_.mesh, c);
        const bool touched = std::ranges::any_of(of_cell, [&](VertexId v) { return before.contains(v); });
        if (touched) reached.insert(of_cell.begin(), of_cell.end());
      }
    }
    return std::ranges::any_of(q_, [&](const Corner& corner) { return reached.contains(corner.v); });
  }

  const WitnessStep& step_;
  Bytes bytes_;
  int time_unit_ = 0;
  Side p_, q_;
  Rational g_;
  mpq_class l_, u_;
};

}  // namespace

std::optional<std::string> fault_of_witness(const WitnessStep& step, std::string_view payload) {
  try {
    Judge(step, payload).judge();
  } catch (const Fault& fault) {
    return fault.reason;
  }
  return std::nullopt;
}

}  // namespace noli
