// SPDX-License-Identifier: Apache-2.0
//
// Generators of adversarial queries. Each belongs to a family, which says what it attacks, and makes queries of one
// type. It declares the answers it can give: no other occurs, and each of them is at least a twentieth of its output.
// Many queries are made backwards from a known contact, and then carry their answer with them.
//
// All coordinates are finite doubles; a generator uses nothing but the random numbers it is given.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audit/fuzz/queries/recipes.h"

namespace noli::audit {

/// A query with doubles, and its answer where the construction implies it.
struct Generated {
  AnyQuery query;
  std::optional<ContactKind> truth;
};

/// Indexed by ContactKind.
using Answers = std::array<bool, 4>;

struct QueryGenerator {
  std::string_view family;   ///< "grid", ...
  std::string_view attacks;  ///< one line: what in a predicate it is made to break
  QueryType type;
  Answers declared;
  Generated (*make)(const QueryType& type, const Answers& declared, Random& random);

  /// "grid/vertex_edge_2d", ...
  std::string name() const;
  Generated operator()(Random& random) const { return make(type, declared, random); }
};

/// All generators; the order never depends on anything.
std::span<const QueryGenerator> query_generators();

/// A family, from which query_generators() makes one generator per type.
struct QueryFamily {
  std::string_view name, attacks;
  std::vector<QueryType> types;
  Answers declared;  ///< a kind that does not exist for a type is left out for it
  Generated (*make)(const QueryType& type, const Answers& declared, Random& random);
};

// What the families share.
inline constexpr Answers every_answer = {true, true, true, true};
inline constexpr Answers no_crossing = {true, true, false, true};
inline constexpr QueryType vertex_face = {FeaturePair::vertex_face, 3};
inline constexpr QueryType edge_edge = {FeaturePair::edge_edge, 3};
inline constexpr QueryType vertex_edge_3d = {FeaturePair::vertex_edge, 3};
inline constexpr QueryType vertex_edge_2d = {FeaturePair::vertex_edge, 2};
inline constexpr Flavour plain_flavour = {any_directions, 1 << 16, 1 << 16, any_time};
inline std::vector<QueryType> every_type() { return {all_query_types.begin(), all_query_types.end()}; }
inline std::vector<QueryType> solid_types() { return {vertex_face, edge_edge}; }  ///< of four points in space
inline std::vector<QueryType> crossing_types() { return {vertex_face, edge_edge, vertex_edge_2d}; }
inline std::vector<QueryType> types_with_edges() { return {vertex_face, edge_edge, vertex_edge_3d, vertex_edge_2d}; }
inline std::vector<QueryType> types_with_edges_in_space() { return {vertex_face, edge_edge, vertex_edge_3d}; }

/// Where the families are defined: generators_position.cpp, ...
std::vector<QueryFamily> families_of_position();  ///< special positions of the features at the contact
std::vector<QueryFamily> families_of_motion();    ///< special motions
std::vector<QueryFamily> families_of_number();    ///< special numbers

/// One of the declared answers, each as likely.
ContactKind random_answer(const Answers& declared, Random& random);

// Finishing a query: exact changes that keep its answer but hide the special position that it was constructed in, then
// the step from whole numbers to doubles.

/// Exponents of the powers of two with which the axes are multiplied.
using AxisExponents = std::array<int, 3>;

/// Sheared and turned (whole_query.h), its points renamed (the other edge first, the corners of the face in another
/// order), and each axis multiplied by a power of two. Preconditions: what comes out is exactly a double;
/// coordinates below 2^53 even after that. Throws std::logic_error when a whole number is too large.
Generated finish(Made made, Random& random, const AxisExponents& exponents);

/// The same with one power of two between 2^-40 and 1 for all axes.
Generated finish(Made made, Random& random);

}  // namespace noli::audit
