// SPDX-License-Identifier: Apache-2.0
//
// Do two simplices meet, at one instant? Exact, for any finite doubles.
//
// Simplices are closed and may be degenerate: a triangle whose corners are on a line is a segment or a point, and
// counts as such. Signs are filtered: double precision with an error bound decides most of them, integers of fixed
// width or of any width the rest.
//
// For moving simplices see include/noli/contact.h.
#pragma once

#include <array>

#include <noli/query.h>

namespace noli {

template <int Dim>
using Segment = std::array<Point<Dim>, 2>;
template <int Dim>
using Triangle = std::array<Point<Dim>, 3>;

using Segment2 = Segment<2>;
using Segment3 = Segment<3>;
using Triangle2 = Triangle<2>;
using Triangle3 = Triangle<3>;

/// The sign of (b - a) x (c - a): +1 if a, b, c turn counterclockwise, 0 if they are on a line.
int orientation(const Point2& a, const Point2& b, const Point2& c);

/// The sign of det(b - a, c - a, d - a): +1 if d is on the side from which a, b, c turn counterclockwise, 0 if they are
/// in a plane.
int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

bool intersects(const Point2& p, const Segment2& s);
bool intersects(const Point3& p, const Segment3& s);
bool intersects(const Point2& p, const Triangle2& t);
bool intersects(const Point3& p, const Triangle3& t);
bool intersects(const Segment2& s, const Segment2& r);
bool intersects(const Segment3& s, const Segment3& r);
bool intersects(const Segment2& s, const Triangle2& t);
bool intersects(const Segment3& s, const Triangle3& t);
bool intersects(const Triangle2& s, const Triangle2& t);
bool intersects(const Triangle3& s, const Triangle3& t);

}  // namespace noli
