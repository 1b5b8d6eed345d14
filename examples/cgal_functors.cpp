// SPDX-License-Identifier: Apache-2.0
//
// Noli among the points and numbers of CGAL: a functor says when two edges first meet, the time becomes an algebraic
// number of CGAL, is compared there with another one, and comes back.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <noli/cgal.h>

#include <cstdlib>
#include <iostream>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using P = K::Point_3;

int main() {
  // The first edge turns and sinks, the second stands still.
  const noli::Edge_edge_time_of_impact_3<K> time_of_impact;
  const auto time = time_of_impact(P(-1, 0, 1), P(1, 0, 2), P(0, -1, 0), P(0, 1, 0),                  // at t = 0
                                   P(-1, -1, -1), P(2, 1, -1), P(0, -1, 0), P(0, 1, 0));              // at t = 1
  const bool meet = noli::Edge_edge_contact_3<K>()(P(-1, 0, 1), P(1, 0, 2), P(0, -1, 0), P(0, 1, 0),  //
                                                   P(-1, -1, -1), P(2, 1, -1), P(0, -1, 0), P(0, 1, 0));
  if (!time || !meet) return EXIT_FAILURE;
  std::cout.precision(17);
  std::cout << "first contact at a time in [" << time->lower() << ", " << time->upper() << "]\n";

  const noli::AlgebraicKernel algebra;
  const auto number = noli::to_algebraic_real_1(*time);
  std::cout << "root of " << algebra.compute_polynomial_1_object()(number) << '\n';

  const auto half = algebra.construct_algebraic_real_1_object()(CGAL::Gmpq(1, 2));
  const auto order = algebra.compare_1_object()(number, half);
  std::cout << "which is " << (order == CGAL::SMALLER ? "before" : "not before") << " the middle of the step\n";

  const noli::TimeOfImpact back = noli::from_algebraic_real_1(number);
  std::cout << "and comes back " << (back == *time ? "as it was" : "changed") << '\n';
  return back == *time ? EXIT_SUCCESS : EXIT_FAILURE;
}
