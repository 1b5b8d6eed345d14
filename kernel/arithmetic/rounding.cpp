// SPDX-License-Identifier: Apache-2.0
#include "kernel/arithmetic/rounding.h"

#include <CGAL/Interval_nt.h>

#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>

namespace noli {
namespace {

/// A value the compiler cannot know.
double opaque(double x) {
  volatile double hidden = x;
  return hidden;
}

/// Sets a rounding mode for a scope.
class RoundingMode {
 public:
  explicit RoundingMode(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;
  ~RoundingMode() { std::fesetround(before_); }

 private:
  int before_;
};

// Operations between opaque operands with an opaque result: they happen at run time, in the mode that is set.
double sum(double a, double b) { return opaque(opaque(a) + opaque(b)); }
double difference(double a, double b) { return opaque(opaque(a) - opaque(b)); }
double product(double a, double b) { return opaque(opaque(a) * opaque(b)); }
double ratio(double a, double b) { return opaque(opaque(a) / opaque(b)); }
double root(double a) { return opaque(std::sqrt(opaque(a))); }

constexpr double ulp_of_one = 0x1p-52;

bool nearest_is_double() {
  // In the 64 bits of an x87 register, the first would keep the small term and then round up: double rounding.
  const bool no_excess = sum(1, 0x1.002p-53) == 1 + ulp_of_one && sum(1, 0x1p-53) == 1 &&
                         sum(1 + ulp_of_one, 0x1p-53) == 1 + 2 * ulp_of_one && difference(1, 0x1p-54) == 1;
  return no_excess && ratio(1, 3) == 0x1.5555555555555p-2 && product(0x1.0000001p0, 0x1.0000001p0) == 0x1.0000002p0 &&
         root(2) == 0x1.6a09e667f3bcdp0;
}

bool nothing_is_contracted() {
  const double a = opaque(1 + 0x1p-30), b = opaque(1 - 0x1p-30), c = opaque(-1);
  return opaque(a * b + c) == 0;  // a fused operation gives -2^-60
}

/// Compares bits: a processor that treats subnormals as zero does so in comparisons too.
bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool subnormals_are_kept() {
  return same_bits(sum(0x1p-1074, 0x1p-1074), 0x1p-1073) && same_bits(product(0x1p-537, 0x1p-537), 0x1p-1074) &&
         same_bits(difference(0x1.8p-1022, 0x1p-1022), 0x1p-1023);
}

bool rounds_upward() {
  const RoundingMode up(FE_UPWARD);
  return sum(1, 0x1p-100) == 1 + ulp_of_one && difference(-1, 0x1p-100) == -1 &&
         product(1 + ulp_of_one, 1 + ulp_of_one) == 1 + 3 * ulp_of_one && ratio(1, 3) == 0x1.5555555555556p-2 &&
         ratio(2, 3) == 0x1.5555555555556p-1 && root(2) == 0x1.6a09e667f3bcdp0 && root(3) == 0x1.bb67ae8584cabp0;
}

bool rounds_downward() {
  const RoundingMode down(FE_DOWNWARD);
  return sum(1, 0x1p-100) == 1 && difference(-1, 0x1p-100) == -1 - ulp_of_one &&
         product(1 + ulp_of_one, 1 + ulp_of_one) == 1 + 2 * ulp_of_one && ratio(1, 3) == 0x1.5555555555555p-2 &&
         ratio(2, 3) == 0x1.5555555555555p-1 && root(2) == 0x1.6a09e667f3bccp0 && root(3) == 0x1.bb67ae8584caap0;
}

bool intervals_enclose() {
  using Interval = CGAL::Interval_nt<false>;
  const Interval::Protector protector;
  const Interval one(opaque(1)), three(opaque(3)), tiny(opaque(0x1p-100));
  const Interval third = one / three, more = one + tiny, square = more * more;
  return third.inf() == 0x1.5555555555555p-2 && third.sup() == 0x1.5555555555556p-2 && more.inf() == 1 &&
         more.sup() == 1 + ulp_of_one && square.inf() == 1 && square.sup() > 1 + ulp_of_one;
}

RoundingReport run() {
  const RoundingMode nearest(FE_TONEAREST);
  return {.nearest_ok = nearest_is_double() && nothing_is_contracted() && subnormals_are_kept(),
          .directed_ok = rounds_upward() && rounds_downward() && intervals_enclose()};
}

}  // namespace

std::string_view RoundingReport::text() const {
  if (ok()) return "rounding as IEEE 754 says";
  if (nearest_ok) return "directed rounding does not work here: exact arithmetic takes the place of intervals";
  return "doubles are not rounded to nearest here: exact arithmetic takes the place of all filters";
}

const RoundingReport& rounding_self_test() {
  static const RoundingReport report = run();
  return report;
}

}  // namespace noli
