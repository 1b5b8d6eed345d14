// SPDX-License-Identifier: Apache-2.0
//
// The simplest question: does a moving vertex meet a face during a step?
#include <noli/contact.h>

#include <iostream>

namespace {

/// A vertex that moves straight down by 2 over (x, y), and a face in the plane z = 0 that stands still.
noli::VertexFace3 falling_vertex(double x, double y) {
  noli::VertexFace3 query;
  query.x_t0 = {{{x, y, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  query.x_t1 = {{{x, y, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  return query;
}

const char* answer(const noli::VertexFace3& query) { return noli::meet(query) ? "they meet" : "they stay apart"; }

}  // namespace

int main() {
  std::cout << "through the face: " << answer(falling_vertex(0.25, 0.25)) << '\n';
  std::cout << "beside the face: " << answer(falling_vertex(0.75, 0.75)) << '\n';
}
