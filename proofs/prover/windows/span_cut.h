// SPDX-License-Identifier: Apache-2.0
//
// When a span of time is cut into halves: the verifier and the prover do it by the same rule.
//
// Notation
//   restless   a vertex that strays from its chord by more than a twelfth of its shortest edge
//   inside     breakpoints between the ends of the span, of all vertices
#pragma once

#include <cstddef>

namespace noli {

/// A vertex has on average more breakpoints inside than that, and more than one vertex of so many is restless.
/// count_restless() is only called when it matters.
template <class CountRestless>
bool worth_cutting(std::size_t inside, std::size_t vertices, const CountRestless& count_restless) {
  constexpr std::size_t breakpoints = 8, one_of = 16;
  return inside > breakpoints * vertices && count_restless() * one_of > vertices;
}

}  // namespace noli
