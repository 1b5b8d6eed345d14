// SPDX-License-Identifier: Apache-2.0
//
// Builds small bodies of all kinds, one above the other, that can move without ever meeting.
//
// Notation
//   band     the slab that contains a body. Bands are stacked along one direction, some distance apart. Each vertex has
//            a box within its body's band, so bands stay apart as long as vertices stay in their boxes
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <noli/mesh.h>
#include "certificates/vector.h"
#include "tests/kernel/random_numbers.h"

namespace noli::certificates::test {

/// The bodies: a mesh, the box of each vertex, and its group.
template <int Dim>
struct MovingBodies {
  Mesh mesh;
  std::vector<Vector<Dim>> home, reach;  ///< box: home +- reach, in the frame of the bands
  std::vector<std::uint16_t> group;
  std::vector<bool> immovable;
};

template <int Dim>
class BodiesMaker {
 public:
  BodiesMaker(noli::test::Random& random, double eta) : random_(random), eta_(eta) {}

  MovingBodies<Dim> make(int bodies) {
    for (int b = 0; b < bodies; ++b) add_body();
    troupe_.mesh.vertex_count = troupe_.home.size();
    return std::move(troupe_);
  }

 private:
  double between(double low, double high) { return eta_ * (low + (high - low) * random_.unit()); }

  /// `a` and `b` are positions along the band, `height` is the height within it.
  VertexId vertex(double a, double b, double height) {
    Vector<Dim> home;
    home[0] = a;
    if constexpr (Dim == 3) home[1] = b;
    home[Dim - 1] = top_ + up_ + height;
    Vector<Dim> reach = Vector<Dim>::Constant(sway_);
    reach[Dim - 1] = up_;
    troupe_.home.push_back(home);
    troupe_.reach.push_back(reach);
    troupe_.group.push_back(group_);
    troupe_.immovable.push_back(immovable_);
    return static_cast<VertexId>(troupe_.home.size() - 1);
  }

  void add_body() {
    up_ = between(0.1, 0.6);
    sway_ = between(0.2, 1.5);
    group_ = static_cast<std::uint16_t>(random_.below(3));
    immovable_ = random_.below(7) == 0;
    const double length = between(6, 15);
    const double high = Dim == 3 ? body_in_space(length) : body_in_the_plane(length);
    top_ += 2 * up_ + high + between(0.35, 0.9);
  }

  /// Returns the body's height, without the reach of its vertices.
  double body_in_space(double l) {
    const double a = between(-4, 4), b = between(-4, 4);
    Mesh& mesh = troupe_.mesh;
    switch (random_.below(6)) {
      case 0: mesh.faces.push_back({vertex(a, b, 0), vertex(a + l, b, 0), vertex(a, b + l, 0)}); return 0;
      case 1: {  // a strip of four faces
        std::array<VertexId, 6> v;
        for (int i = 0; i < 6; ++i) {
          v[static_cast<std::size_t>(i)] = vertex(a + 0.5 * l * i - l, b + (i % 2 == 0 ? 0 : l), 0);
        }
        for (std::size_t i = 0; i < 4; ++i) mesh.faces.push_back({v[i], v[i + 1], v[i + 2]});
        return 0;
      }
      case 2: mesh.edges.push_back({vertex(a - l, b, 0), vertex(a + l, b + 0.1 * l, 0)}); return 0;
      case 3: {
        const VertexId middle = vertex(a, b + 0.3 * l, 0);
        mesh.edges.push_back({vertex(a - l, b, 0), middle});
        mesh.edges.push_back({middle, vertex(a + 0.2 * l, b - l, 0)});
        return 0;
      }
      case 4:
        for (const double place : {0.0, between(0.6, 2.5) + 2 * sway_}) mesh.points.push_back(vertex(a + place, b, 0));
        return 0;
      default: {  // a tip, up or down
        const bool down = random_.below(2) == 0;
        const double low = down ? l : 0;
        mesh.faces.push_back(
            {vertex(a, b, l - low), vertex(a + 0.4 * l, b, low), vertex(a + 0.1 * l, b + 0.3 * l, low)});
        return l;
      }
    }
  }

  double body_in_the_plane(double l) {
    const double a = between(-4, 4);
    Mesh& mesh = troupe_.mesh;
    switch (random_.below(4)) {
      case 0: mesh.edges.push_back({vertex(a, 0, 0), vertex(a + l, 0, 0)}); return 0;
      case 1: {
        VertexId last = vertex(a - 2 * l, 0, 0);
        for (int i = 1; i < 5; ++i) {
          const VertexId next = vertex(a + (i - 2) * l, 0, 0);
          mesh.edges.push_back({last, next});
          last = next;
        }
        return 0;
      }
      case 2:
        for (const double place : {0.0, between(0.6, 2.5) + 2 * sway_}) mesh.points.push_back(vertex(a + place, 0, 0));
        return 0;
      default: {
        const bool down = random_.below(2) == 0;
        const VertexId tip = vertex(a, 0, down ? 0 : l);
        for (const double side : {-0.3, 0.4}) mesh.edges.push_back({tip, vertex(a + side * l, 0, down ? l : 0)});
        return l;
      }
    }
  }

  noli::test::Random& random_;
  double eta_;
  MovingBodies<Dim> troupe_;
  double top_ = 0, up_ = 0, sway_ = 0;
  std::uint16_t group_ = 0;
  bool immovable_ = false;
};

}  // namespace noli::certificates::test
