// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "trajectory/text.h"

namespace noli::audit {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t axes(const AnyQuery& query) { return static_cast<std::size_t>(query.dimension); }

constexpr const char* no_eta = "none";

/// x_a - x_b at time t, as rounding has it.
Point3 between(const AnyQuery& query, const std::array<std::size_t, 2>& points, double t) {
  const auto [a, b] = points;
  Point3 d{};
  for (std::size_t k = 0; k < axes(query); ++k) {
    d[k] = (1 - t) * (query.x_t0[a][k] - query.x_t0[b][k]) + t * (query.x_t1[a][k] - query.x_t1[b][k]);
  }
  return d;
}

double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The number itself, a neighbour, or a part of it; 0 instead of what is not finite.
double near(double x, Random& random) {
  if (!std::isfinite(x)) return 0;
  switch (random.below(6)) {
    case 0:
    case 1: return x;
    case 2: return std::nextafter(x, 0.0);
    case 3: return std::isfinite(std::nextafter(x, infinity)) ? std::nextafter(x, infinity) : x;
    case 4: return x * 0.5;
    default: return x * random.unit();
  }
}

double random_time(Random& random) {
  constexpr std::array<double, 4> times = {0, 0.5, 0.25, 1};
  return random.one_in(3) ? random.unit() : random.one_of(times);
}

double make_eta(const AnyQuery& query, const std::array<std::size_t, 2>& points, Random& random) {
  if (random.one_in(8)) return 0;
  const Point3 d = between(query, points, random_time(random));
  const double greatest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  const double eta = near(random.one_in(3) ? greatest : std::sqrt(dot(d, d)), random);
  return random.one_in(2) ? eta : std::ldexp(eta, -static_cast<int>(random.between(1, 30)));
}

Point3 make_normal(const AnyQuery& query, const std::array<std::size_t, 2>& points, Random& random) {
  Point3 n{};
  if (random.one_in(3)) {
    n[random.below(axes(query))] = random.one_in(2) ? 1 : -1;
    return n;
  }
  if (random.one_in(2)) {
    for (std::size_t k = 0; k < axes(query); ++k) n[k] = static_cast<double>(random.between(-3, 3));
    return n;
  }
  n = between(query, points, random_time(random));
  const bool finite = std::all_of(n.begin(), n.end(), [](double x) { return std::isfinite(x); });
  return finite ? n : Point3{1, 0, 0};
}

/// Takes words and numbers off a line, and remembers whether all were as expected.
class Taker {
 public:
  explicit Taker(std::string_view line) : words_(line) {}

  void word(std::string_view expected) { good_ = words_.next() == expected && good_; }

  double number() { return number(words_.next()); }

  std::optional<double> number_or(std::string_view none) {
    const std::string_view text = words_.next();
    return text == none ? std::nullopt : std::optional(number(text));
  }
  std::size_t below(std::size_t limit) {
    const double value = number();
    for (std::size_t i = 0; i < limit; ++i) {
      if (value == static_cast<double>(i)) return i;
    }
    good_ = false;
    return 0;
  }

  bool good() { return good_ && words_.next().empty(); }

 private:
  double number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    good_ = good_ && error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    return value;
  }

  Words words_;
  bool good_ = true;
};

}  // namespace

bool fits(const AnyQuery& query, const Probe& probe) {
  const std::size_t first = first_size(query.pair);
  const bool planar = query.pair == FeaturePair::vertex_edge || query.pair == FeaturePair::vertex_vertex;
  return probe.points[0] < first && probe.points[1] >= first && probe.points[1] < query.size() &&
         (query.dimension == 3 || planar);
}

Probe make_probe(const AnyQuery& query, bool distance, Random& random) {
  const std::size_t first = first_size(query.pair);
  Probe probe;
  probe.points = {random.below(first), first + random.below(query.size() - first)};
  probe.rays = {random.one_in(3), random.one_in(3)};
  if (distance) probe.eta = make_eta(query, probe.points, random);
  probe.normal = make_normal(query, probe.points, random);
  probe.from = random.one_in(3) ? random_time(random) : 0;
  if (!random.one_in(4)) probe.gap = near(dot(probe.normal, between(query, probe.points, random_time(random))), random);
  return probe;
}

std::string probe_line(const AnyQuery& query, const Probe& probe) {
  return fmt::format("# noli-fuzz dimension {} eta {} normal {} {} {} gap {} from {} points {} {} rays {} {}",
                     query.dimension, probe.eta ? fmt::format("{}", *probe.eta) : no_eta, probe.normal[0],
                     probe.normal[1], probe.normal[2], probe.gap, probe.from, probe.points[0], probe.points[1],
                     probe.rays[0] ? 1 : 0, probe.rays[1] ? 1 : 0);
}

std::optional<SavedProbe> parse_probe_line(std::string_view line) {
  Taker take(line);
  SavedProbe saved;
  Probe& probe = saved.probe;
  take.word("#");
  take.word("noli-fuzz");
  take.word("dimension");
  saved.dimension = static_cast<int>(take.below(4));  // 0 and 1 are refused below
  take.word("eta");
  probe.eta = take.number_or(no_eta);
  take.word("normal");
  for (double& x : probe.normal) x = take.number();
  take.word("gap");
  probe.gap = take.number();
  take.word("from");
  probe.from = take.number();
  take.word("points");
  for (std::size_t& point : probe.points) point = take.below(4);
  take.word("rays");
  for (bool& ray : probe.rays) ray = take.below(2) == 1;
  const bool possible = saved.dimension >= 2 && probe.eta.value_or(0) >= 0 && probe.from >= 0;
  return take.good() && possible ? std::optional(saved) : std::nullopt;
}

}  // namespace noli::audit
