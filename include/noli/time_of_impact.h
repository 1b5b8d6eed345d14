// SPDX-License-Identifier: Apache-2.0
//
// When two features first meet, as an exact algebraic number, and what kind of contact it is.
//
//   if (const auto first = noli::first_contact(query)) {
//     std::printf("%s at %.17g\n", noli::name(first->kind).data(), first->time.lower());
//   }
//
// Notation
//   time of impact   the least t in [0, 1] at which the features meet. It is stored as the root of an integer
//                    polynomial in a dyadic interval, so nothing is rounded: it compares exactly, and lower() and
//                    upper() are the nearest doubles. noli/cgal.h converts it to a CGAL number, which has arithmetic,
//                    or to an MPFR number of any precision
//
// Kinds, judged at the time of impact t*:
//   persistent  they meet during a whole interval that begins at t* (of positive length, within the step)
//   crossing    t* is inside the open step, the contact is of codimension one (vertex_face and edge_edge in 3D: at t*
//               the four points span exactly a plane; vertex_edge in 2D: the three points span exactly a line), it is
//               relatively interior to both features, and the orientation determinant changes sign at t*
//   touching    every other contact
//   apart       they do not meet
//
// Preconditions and errors as for noli/contact.h. Thread safety: any thread; times are values that share immutable
// data.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include <noli/query.h>

namespace noli {

class AlgebraicNumber;

class TimeOfImpact {
 public:
  /// 0.
  TimeOfImpact();
  /// Exact. Throws std::domain_error unless 0 <= t <= 1.
  static TimeOfImpact from_double(double t);
  /// num / den. Throws std::domain_error unless 0 <= num / den <= 1 and den is not 0.
  static TimeOfImpact from_rational(std::int64_t num, std::int64_t den);

  /// The largest double <= this time.
  double lower() const;
  /// The smallest double >= this time.
  double upper() const;

  friend std::strong_ordering operator<=>(const TimeOfImpact& a, const TimeOfImpact& b) { return a.compare(b); }
  friend bool operator==(const TimeOfImpact& a, const TimeOfImpact& b) { return (a <=> b) == 0; }

  // For Noli itself: the header of AlgebraicNumber is not installed.
  explicit TimeOfImpact(AlgebraicNumber value);
  const AlgebraicNumber& algebraic() const { return *value_; }

 private:
  std::strong_ordering compare(const TimeOfImpact& other) const;

  std::shared_ptr<const AlgebraicNumber> value_;
};

enum class ContactKind { apart, touching, crossing, persistent };

/// The name used in JSON: "apart", "touching", "crossing", "persistent".
constexpr std::string_view name(ContactKind kind) {
  switch (kind) {
    case ContactKind::apart: return "apart";
    case ContactKind::touching: return "touching";
    case ContactKind::crossing: return "crossing";
    case ContactKind::persistent: return "persistent";
  }
  return "";
}

struct FirstContact {
  ContactKind kind = ContactKind::touching;  ///< never `apart`
  TimeOfImpact time;                         ///< the least t in [0, 1] at which the features meet
};

/// The first contact of the step, or nothing if the features stay apart.
/// Slower than `contact` (noli/contact.h): microseconds, with allocation. Call it for queries known to be in contact.
template <FeaturePair Pair, int Dim>
std::optional<FirstContact> first_contact(const Query<Pair, Dim>& query);

}  // namespace noli
