// SPDX-License-Identifier: Apache-2.0
#include "oracle/time.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace noli::oracle {

namespace {

/// How often the isolating interval is halved before a Sturm sequence decides a sign.
constexpr int patience = 24;

}  // namespace

std::vector<Time> Time::roots_of(const Polynomial& p) {
  std::vector<Time> times;
  if (p.degree() < 1) return times;
  const Polynomial defining = square_free(p.primitive());
  for (IsolatedRoot& root : roots_in_unit_interval(defining)) times.push_back(Time(defining, std::move(root)));
  return times;
}

void Time::halve() const {
  const Dyadic mid = middle(root_.lo, root_.hi);
  const int at_mid = defining_.sign_at(mid);
  if (at_mid == 0) {
    root_ = {mid, mid};
  } else if (at_mid == defining_.sign_at(root_.lo)) {
    root_.lo = mid;
  } else {
    root_.hi = mid;
  }
}

int Time::sign_of(const Polynomial& q) const {
  if (is_dyadic()) return q.sign_at(root_.lo);
  if (q.is_zero()) return 0;
  if (const int sign = sign_throughout(q, root_.lo, root_.hi); sign != 0) return sign;
  if (remainder(q, defining_).is_zero()) return 0;
  for (int i = 1; i <= patience; ++i) {
    halve();
    if (is_dyadic()) return q.sign_at(root_.lo);
    if (i % 6 != 0) continue;
    if (const int sign = sign_throughout(q, root_.lo, root_.hi); sign != 0) return sign;
  }
  return sign_at_root(q, defining_, root_);
}

int Time::sign_after(const Polynomial& q) const {
  Polynomial p = q;
  while (!p.is_zero()) {
    if (const int sign = sign_of(p); sign != 0) return sign;
    p = p.derivative();
  }
  return 0;
}

bool Time::changes_sign(const Polynomial& q) const {
  int multiplicity = 0;
  for (Polynomial p = q; !p.is_zero() && sign_of(p) == 0; p = p.derivative()) ++multiplicity;
  return !q.is_zero() && multiplicity % 2 == 1;
}

int Time::compare(const Dyadic& t) const {
  if (oracle::compare(root_.hi, t) < 0) return -1;
  if (oracle::compare(root_.lo, t) > 0) return 1;
  if (is_dyadic()) return 0;
  const int at_t = defining_.sign_at(t);
  if (at_t == 0) return 0;
  return at_t == defining_.sign_at(root_.lo) ? 1 : -1;
}

int Time::compare(const Time& other) const {
  if (other.is_dyadic()) return compare(other.root_.lo);
  if (is_dyadic()) return -other.compare(root_.lo);
  if (const int sign = compare(other.root_.lo); sign <= 0) return -1;
  if (const int sign = compare(other.root_.hi); sign >= 0) return 1;
  // Inside the interval that isolates `other`: either the same number, or on one side of its only root.
  const int here = sign_of(other.defining_);
  if (here == 0) return 0;
  return here == other.defining_.sign_at(other.root_.lo) ? -1 : 1;
}

double Time::lower() const {
  // Non-negative doubles are ordered like their bit patterns. Halving first keeps the numbers small in the search
  // below.
  for (int i = 0; i < 60 && !is_dyadic(); ++i) halve();
  std::uint64_t below = std::bit_cast<std::uint64_t>(0.0), above = std::bit_cast<std::uint64_t>(1.0) + 1;
  if (const double guess = approximation(); guess > 1e-300 && guess < 1) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(guess);
    if (compare(std::bit_cast<double>(bits - 4)) >= 0) below = bits - 4;
    if (compare(std::bit_cast<double>(bits + 4)) < 0) above = bits + 4;
  }
  while (above - below > 1) {
    const std::uint64_t mid = below + (above - below) / 2;
    (compare(std::bit_cast<double>(mid)) >= 0 ? below : above) = mid;
  }
  return std::bit_cast<double>(below);
}

double Time::approximation() const {
  mpq_class value(root_.lo.numerator);
  mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), root_.lo.exponent);
  return value.get_d();
}

void sort_distinct(std::vector<Time>& times) {
  std::sort(times.begin(), times.end(), [](const Time& a, const Time& b) { return a.compare(b) < 0; });
  const auto same = [](const Time& a, const Time& b) { return a.compare(b) == 0; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
}

}  // namespace noli::oracle
