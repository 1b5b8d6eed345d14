// SPDX-License-Identifier: Apache-2.0
//
// Reads and writes files of queries: two features over one step, with or without the true answer.
//
// A query is 2 n rows, one a point: n at t = 0, then n at t = 1 in the same order (n = 4 for vertex_face and
// edge_edge, 3 for vertex_edge, 2 for vertex_vertex; the points of the first feature first). A row is
//   x num, x den, y num, y den, z num, z den [, label]
// with decimal integers of any length whose quotient is exactly a double, and a label 0 (apart) or 1 (they meet) that
// all rows of a query share; either every row of a file has it or none. A numerator -0 is the double -0.0. Blank lines
// are skipped, and comments: lines that begin with #.
//
// Nothing is rounded: a quotient that is not a double is an error.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// Which two features the queries of a file are about.
enum class QueryKind { vertex_face, edge_edge, vertex_edge, vertex_vertex };

/// Points of both features together: 4, 4, 3, 2.
std::size_t point_count(QueryKind kind);

/// The kind in a file's name: "vertex-face", "edge-edge", "vertex-edge" or "vertex-vertex", also with '_' for '-'.
/// Folders do not count. Nothing when the name contains no kind, or more than one.
std::optional<QueryKind> kind_from_file_name(const std::filesystem::path& path);

struct QueryRecord {
  std::array<Position, 4> x_t0{};  ///< the first point_count(kind) count; the rest are zero
  std::array<Position, 4> x_t1{};
  std::optional<bool> label;  ///< whether the file says that they meet
  friend bool operator==(const QueryRecord&, const QueryRecord&) = default;
};

/// Reads a file of queries of one kind, at least one. Throws InputError with the line: a wrong number of columns,
/// something that is not an integer, a zero denominator, a quotient that is not a double, a label other than 0 and 1, a
/// label that differs within a query, rows that do not make a whole number of queries.
std::vector<QueryRecord> read_query_csv(const std::filesystem::path& path, QueryKind kind);

/// The same for a text in memory; errors name `file`.
std::vector<QueryRecord> parse_query_csv(std::string_view text, const std::string& file, QueryKind kind);

/// The text of queries. Reading it gives the same doubles bit for bit, and the same labels. Preconditions: finite
/// coordinates; all records have a label or none has (else std::invalid_argument).
std::string format_query_csv(QueryKind kind, std::span<const QueryRecord> records);

/// Sets `value` to numerator / denominator, two decimal integers of any length with or without a sign. Returns "" when
/// the quotient is exactly a finite double, otherwise what is wrong: not an integer, a zero denominator, a quotient
/// that is not a double. A zero numerator with a minus sign gives -0.0.
std::string parse_exact_quotient(std::string_view numerator, std::string_view denominator, double& value);

/// "NUMERATOR,DENOMINATOR" in lowest terms, the denominator a power of two; -0.0 is "-0,1". Precondition: finite.
std::string format_exact_quotient(double value);

}  // namespace noli
