// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracle.h"

#include <algorithm>

#include "oracle/features.h"

namespace noli::oracle {

namespace {

struct Range {
  double least, greatest;
};

Range range(const std::array<Coordinates, 4>& x, std::size_t begin, std::size_t end, std::size_t axis) {
  Range result{x[begin][axis], x[begin][axis]};
  for (std::size_t i = begin + 1; i < end; ++i) {
    result = {std::min(result.least, x[i][axis]), std::max(result.greatest, x[i][axis])};
  }
  return result;
}

/// -1: the first feature is strictly below the second along the axis, 1: above, 0: neither.
int order(const std::array<Coordinates, 4>& x, Pair pair, std::size_t axis) {
  const Range a = range(x, 0, first_count(pair), axis), b = range(x, first_count(pair), point_count(pair), axis);
  return a.greatest < b.least ? -1 : a.least > b.greatest ? 1 : 0;
}

bool crosses(const ContactCondition& contact, const std::optional<Polynomial>& orientation, const Time& t) {
  if (!orientation || t.compare(Dyadic{0, 0}) == 0 || t.compare(Dyadic{1, 0}) == 0) return false;
  const auto positive = [&](const Polynomial& p) { return t.sign_of(p) > 0; };
  return std::all_of(contact.interior.begin(), contact.interior.end(), positive) && t.changes_sign(*orientation);
}

Kind kind_at(const ContactCondition& contact, const std::optional<Polynomial>& orientation, const Time& t) {
  if (t.compare(Dyadic{1, 0}) != 0 && holds_after(contact.condition, t)) return Kind::persistent;
  return crosses(contact, orientation, t) ? Kind::crossing : Kind::touching;
}

}  // namespace

bool axis_separates(const Motion& motion) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(motion.dimension); ++axis) {
    const int before = order(motion.x_t0, motion.pair, axis);
    if (before != 0 && before == order(motion.x_t1, motion.pair, axis)) return true;
  }
  return false;
}

Answer first_contact(const Motion& motion) {
  if (axis_separates(motion)) return {};
  const std::vector<Vector> x = integer_paths(motion, Unit::per_axis).x;
  // If the orientation is not the zero polynomial, its roots are the only candidates, and often it has none.
  const std::optional<Polynomial> necessary = orientation(motion, x);
  const bool few = necessary && !necessary->is_zero();
  const std::vector<Time> candidates = few ? Time::roots_of(*necessary) : std::vector<Time>();
  if (few && candidates.empty()) return {};
  const ContactCondition contact = contact_condition(motion, x, necessary);
  std::optional<Time> time = few ? first_of(candidates, contact.condition) : first_time(contact.condition);
  if (!time) return {};
  return {kind_at(contact, necessary, *time), std::move(time)};
}

std::optional<Time> first_within(const Motion& motion, double distance) {
  const IntegerPaths paths = integer_paths(motion, Unit::common, {distance});
  return first_time(nearness_condition(motion, paths.x, paths.also[0]));
}

}  // namespace noli::oracle
