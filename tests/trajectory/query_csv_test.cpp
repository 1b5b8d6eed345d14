// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/query_csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "support.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

using testing::input_error;

const QueryKind all_kinds[] = {QueryKind::vertex_face, QueryKind::edge_edge, QueryKind::vertex_edge,
                               QueryKind::vertex_vertex};

std::string repeat(const std::string& text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

TEST(QueryCsv, PointsInOrder) {
  const auto queries =
      parse_query_csv("1,1,2,1,3,1\r\n4,1,5,1,6,1\r\n\r\n 7 ,\t2,8,1,9,1\n-1,4,0,1,0,1", "t", QueryKind::vertex_vertex);
  ASSERT_EQ(queries.size(), 1u);
  EXPECT_EQ(queries[0].x_t0, (std::array<Position, 4>{{{1, 2, 3}, {4, 5, 6}}}));
  EXPECT_EQ(queries[0].x_t1, (std::array<Position, 4>{{{3.5, 8, 9}, {-0.25, 0, 0}}}));
  EXPECT_FALSE(queries[0].label.has_value());
}

TEST(QueryCsv, CommentsAreSkippedButCounted) {
  const std::string text = "# a comment, with a comma\n1,1,2,1,3,1\n  #\n";
  EXPECT_EQ(parse_query_csv(text + repeat("1,1,2,1,3,1\n", 3) + "#", "t", QueryKind::vertex_vertex).size(), 1u);
  try {
    parse_query_csv(text + "1,1,2,1,3,#\n", "t", QueryKind::vertex_vertex);
    ADD_FAILURE() << "a comment within a line";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 4"), std::string::npos) << error.what();
  }
}

TEST(QueryCsv, EveryKindAndBothLabels) {
  for (const QueryKind kind : all_kinds) {
    const std::size_t rows = 2 * point_count(kind);
    const auto queries = parse_query_csv(repeat("1,1,2,1,3,1,1\n", rows) + repeat("1,1,2,1,3,1,0\n", rows), "t", kind);
    ASSERT_EQ(queries.size(), 2u);
    EXPECT_EQ(queries[0].label, true);
    EXPECT_EQ(queries[1].label, false);
    EXPECT_EQ(queries[1].x_t1[point_count(kind) - 1], (Position{1, 2, 3}));
  }
}

TEST(QueryCsv, RowsPerQuery) {
  EXPECT_EQ(point_count(QueryKind::vertex_face), 4u);
  EXPECT_EQ(point_count(QueryKind::edge_edge), 4u);
  EXPECT_EQ(point_count(QueryKind::vertex_edge), 3u);
  EXPECT_EQ(point_count(QueryKind::vertex_vertex), 2u);
}

const std::string row = "1,1,2,1,3,1\n";
const std::string labelled = "1,1,2,1,3,1,1\n";

struct BadCsv {
  const char* name;
  std::string text;
  std::string message;
  friend void PrintTo(const BadCsv& bad, std::ostream* out) { *out << bad.name; }
};
const BadCsv bad_csvs[] = {
    {"empty", "", "is empty"},
    {"blank", "\n \n", "holds no queries"},
    {"one_row_missing", repeat(row, 7), "line 7: the file ends within a query: 7 rows, expected a multiple of 4"},
    {"five_columns", row + "1,1,2,1,3\n", "line 2: expected 6 columns, or 7 with a label, found 5"},
    {"eight_columns", row + "1,1,2,1,3,1,1,1\n", "line 2: expected 6 columns, or 7 with a label, found 8"},
    {"trailing_comma", row + "1,1,2,1,3,1,\n", "line 2: a label, but the rows before have none"},
    {"late_label", row + labelled, "line 2: a label, but the rows before have none"},
    {"missing_label", labelled + row, "line 2: the label is missing, the rows before have one"},
    {"label_two", "\n1,1,2,1,3,1,2\n", "line 2: expected the label 0 or 1, found '2'"},
    {"label_word", "1,1,2,1,3,1,true\n", "line 1: expected the label 0 or 1, found 'true'"},
    {"no_label", "1,1,2,1,3,1,\n", "line 1: expected the label 0 or 1, found ''"},
    {"labels_differ", labelled + labelled + "1,1,2,1,3,1,0\n",
     "line 3: the label differs from that of the first row of this query"},
    {"zero_denominator", row + "1,1,2,0,3,1\n", "line 2: y: the denominator is zero"},
    {"no_double", row + "1,1,2,1,1,10\n", "line 2: z: the quotient of '1' and '10' is not exactly a double"},
    {"real", "0.5,1,2,1,3,1\n", "line 1: x: expected a whole number, found '0.5'"},
    {"nan", "nan,1,2,1,3,1\n", "line 1: x: expected a whole number, found 'nan'"},
    {"nothing", ",1,2,1,3,1\n", "line 1: x: expected a whole number, found ''"},
    {"semicolons", "1;1;2;1;3;1\n", "line 1: expected 6 columns, or 7 with a label, found 1"},
};

class QueryCsvErrors : public ::testing::TestWithParam<BadCsv> {};
INSTANTIATE_TEST_SUITE_P(All, QueryCsvErrors, ::testing::ValuesIn(bad_csvs),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(QueryCsvErrors, SaysWhatAndWhere) {
  EXPECT_EQ(input_error([] { parse_query_csv(GetParam().text, "bad.csv", QueryKind::vertex_vertex); }),
            "bad.csv: " + GetParam().message);
}

TEST(QueryCsv, RowsMustFitTheKind) {
  EXPECT_EQ(parse_query_csv(repeat(row, 24), "t", QueryKind::vertex_face).size(), 3u);
  EXPECT_EQ(parse_query_csv(repeat(row, 24), "t", QueryKind::vertex_edge).size(), 4u);
  EXPECT_EQ(input_error([] { parse_query_csv(repeat(row, 20), "t", QueryKind::edge_edge); }),
            "t: line 20: the file ends within a query: 20 rows, expected a multiple of 8");
  EXPECT_EQ(input_error([] { parse_query_csv(repeat(row, 20), "t", QueryKind::vertex_edge); }),
            "t: line 20: the file ends within a query: 20 rows, expected a multiple of 6");
}

TEST(QueryCsv, KindFromFileName) {
  EXPECT_EQ(kind_from_file_name("a/erleben-vertex-face-0.csv"), QueryKind::vertex_face);
  EXPECT_EQ(kind_from_file_name("cloth_edge_edge.csv"), QueryKind::edge_edge);
  EXPECT_EQ(kind_from_file_name("cube-cliff-edges-vertex-edge.csv"), QueryKind::vertex_edge);
  EXPECT_EQ(kind_from_file_name("vertex-vertex"), QueryKind::vertex_vertex);
  EXPECT_EQ(kind_from_file_name("edge-edge/queries.csv"), std::nullopt) << "folders do not count";
  EXPECT_EQ(kind_from_file_name("vertex-face-and-edge-edge.csv"), std::nullopt);
  EXPECT_EQ(kind_from_file_name("erleben-cube-cliff-edges-edge-edge-0.csv"), QueryKind::edge_edge);
}

/// Doubles of every size: subnormals, limits, powers, plain ones.
rc::Gen<double> any_double() {
  const auto plain = rc::gen::map(rc::gen::inRange(-1000, 1000), [](int i) { return i / 8.0; });
  const auto scaled =
      rc::gen::map(rc::gen::pair(rc::gen::inRange<std::int64_t>(-(1LL << 53), 1LL << 53), rc::gen::inRange(-1126, 970)),
                   [](const auto& p) { return std::ldexp(static_cast<double>(p.first), p.second); });
  const auto special = rc::gen::element(0.0, -0.0, 0x1p-1074, -0x1p-1074, 0x1.fffffffffffffp-1023, 1e300, -1e300,
                                        1e-300, 0x1.fffffffffffffp1023, 0.1);
  return rc::gen::oneOf(plain, scaled, special);
}

RC_GTEST_PROP(QueryCsv, RoundTripBitForBit, ()) {
  const QueryKind kind = *rc::gen::elementOf(std::vector<QueryKind>(std::begin(all_kinds), std::end(all_kinds)));
  const bool with_label = *rc::gen::arbitrary<bool>();
  std::vector<QueryRecord> queries(*rc::gen::inRange<std::size_t>(1, 4));
  for (QueryRecord& query : queries) {
    for (std::size_t p = 0; p < point_count(kind); ++p) {
      query.x_t0[p] = *rc::gen::container<Position>(any_double());
      query.x_t1[p] = *rc::gen::container<Position>(any_double());
    }
    if (with_label) query.label = *rc::gen::arbitrary<bool>();
  }
  const auto read = parse_query_csv(format_query_csv(kind, queries), "round trip", kind);
  RC_ASSERT(read.size() == queries.size());
  const auto all_bits = [](const auto& x) { return testing::bits({x.begin(), x.end()}); };
  for (std::size_t i = 0; i < read.size(); ++i) {
    RC_ASSERT(all_bits(read[i].x_t0) == all_bits(queries[i].x_t0));
    RC_ASSERT(all_bits(read[i].x_t1) == all_bits(queries[i].x_t1));
    RC_ASSERT(read[i].label == queries[i].label);
  }
}

TEST(QueryCsv, WritesFiles) {
  const test::TemporaryFolder folder;
  const std::vector<QueryRecord> queries{{.x_t0 = {{{1, 2, 3}}}, .x_t1 = {{{0.5, 0, 1e300}}}, .label = true}};
  const std::string text = format_query_csv(QueryKind::vertex_vertex, queries);
  write_file(folder / "q.csv", text);
  EXPECT_EQ(read_query_csv(folder / "q.csv", QueryKind::vertex_vertex), queries);
  EXPECT_THROW(write_file(folder / "no/q.csv", text), std::system_error);
  EXPECT_EQ(input_error([&] { read_query_csv(folder / "none.csv", QueryKind::edge_edge); }),
            (folder / "none.csv").string() + ": cannot be opened: No such file or directory");
}

TEST(QueryCsv, LabelsOfAllOrOfNone) {
  std::vector<QueryRecord> queries(2);
  queries[0].label = true;
  EXPECT_THROW(format_query_csv(QueryKind::edge_edge, queries), std::invalid_argument);
}

}  // namespace
}  // namespace noli
