// SPDX-License-Identifier: Apache-2.0
//
// Triangles made smaller in one place, by bisection of the newest vertex (Mitchell, "A comparison of adaptive
// refinement techniques for elliptic problems", 1989): each triangle has a peak and, opposite to it, a base; two
// triangles that share a base are halved at its middle, which is the peak of their halves. A neighbour whose base is
// another edge is halved first. So no vertex ever lies inside an edge, and the shapes that come about are the first
// ones and a few more.
//
// What this does not do: it does not judge angles, and moves no vertex.
#pragma once

#include <array>

#include "integrator/scene/shapes/shape.h"

namespace noli::integrator {

/// Halves triangles that contain a point of the plane, or have a vertex within `radius` of it, until their edges are at
/// most `longest`. New vertices are numbered after those that were there. Preconditions: the faces are a triangulation
/// in the plane z = 0 in which the longest edge of a triangle is that of its neighbour across it too, as in a lattice
/// of halved rectangles; longest > 0.
void refine(Shape& shape, const std::array<double, 2>& at, double radius, double longest);

}  // namespace noli::integrator
