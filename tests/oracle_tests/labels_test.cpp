// SPDX-License-Identifier: Apache-2.0
//
// Runs the oracle on all published queries with known answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "oracle/oracle.h"
#include "tests/support/real_data.h"
#include "trajectory/formats/query_csv.h"

namespace noli::oracle {
namespace {

Motion motion_of(QueryKind kind, const QueryRecord& record) {
  Motion motion;
  motion.pair = kind == QueryKind::vertex_face ? Pair::vertex_face : Pair::edge_edge;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      motion.x_t0[i][axis] = record.x_t0[i][axis];
      motion.x_t1[i][axis] = record.x_t1[i][axis];
    }
  }
  return motion;
}

TEST(OracleLabels, AgreesWithEveryLabel) {
  const auto folder = test::real_data("queries");
  if (!folder) GTEST_SKIP() << "no real data";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::size_t queries = 0, apart = 0;
  for (const auto& file : files) {
    const QueryKind kind = kind_from_file_name(file).value();
    std::size_t wrong = 0;
    for (const QueryRecord& record : read_query_csv(file, kind)) {
      const bool contact = first_contact(motion_of(kind, record)).kind != Kind::apart;
      wrong += contact != record.label.value();
      apart += !contact;
      ++queries;
    }
    EXPECT_EQ(wrong, 0U) << file;
  }
  EXPECT_GT(queries, 5000U);
  EXPECT_GT(apart, 1000U);
}

}  // namespace
}  // namespace noli::oracle
