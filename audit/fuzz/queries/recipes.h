// SPDX-License-Identifier: Apache-2.0
//
// Queries made backwards from an answer: recipes whose truth is known by construction.
//
// approach   at t* = k / n all points are in the floor, where their hulls meet or not; before, every point of one
//            feature was strictly above every point of the other, afterwards it is strictly below. So t* is the only
//            time at which they can meet. If they do and the points span the floor, the orientation has a simple root
//            there: writing c_i > 0 for the relative heights and w_i for the weights of the contact, sum w_i c_i is not
//            zero.
// carried    at t = 0 and at t = 1 a point of one feature coincides with one of the other, with the same weights: so it
//            does at all times
#pragma once

#include <optional>

#include <noli/time_of_impact.h>
#include "audit/fuzz/queries/meeting.h"
#include "audit/fuzz/queries/whole_query.h"

namespace noli::audit {

/// A query, and its answer where the construction implies it.
struct Made {
  WholeQuery query;
  std::optional<ContactKind> truth;
};

/// What gives a recipe its flavour.
struct Flavour {
  /// Directions on the first `axes` axes; p is not zero.
  Directions (*directions)(Random& random, int axes);
  std::int64_t speed = 1 << 16;         ///< greatest displacement within the floor in an n-th of the step
  std::int64_t height_speed = 1 << 16;  ///< the same across the floor, at least 1
  StepTime (*when)(Random& random);     ///< a time strictly inside the step
};

/// Whether that kind of contact exists for that type at all: crossing needs codimension one.
bool exists(ContactKind kind, const QueryType& type);

/// Displacements that are random in the floor and take the first feature through the second across it.
WholePoints approach(Random& random, const QueryType& type, const Flavour& flavour);

/// A query with that answer. Precondition: exists(kind, type). The truth is always known.
Made recipe(ContactKind kind, const QueryType& type, const Flavour& flavour, Random& random);

/// `carried` with the given place: persistent.
Made carried(const QueryType& type, Place place, const Flavour& flavour, Random& random);

/// Times k / n with n up to 64.
StepTime any_time(Random& random);

/// Directions with components up to 2^4, 2^10, 2^20, 2^30 in size, the exponent chosen each time.
Directions any_directions(Random& random, int axes);

}  // namespace noli::audit
