// SPDX-License-Identifier: Apache-2.0
//
// Tests published queries with known answers: every label, and the share of each file's queries that reach the slower
// stages. The ceilings catch a loss of speed that leaves all answers right.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include <noli/contact.h>
#include "tests/support/real_data.h"
#include "trajectory/formats/query_csv.h"

namespace noli {
namespace {

template <FeaturePair Pair>
bool meet_record(const QueryRecord& record, StageCounters& counters) {
  return meet(Query<Pair, 3>{record.x_t0, record.x_t1}, &counters);
}

/// The shares of a file's queries, in per cent, that may go beyond double, beyond fixed width, and to GMP.
struct Ceilings {
  double exact = 0;
  double interval = 0;
  double gmp = 0;
};

/// Queries of other files must all be decided in double.
const std::map<std::string, Ceilings> ceilings = {
    {"cloth-funnel-edge-edge.csv", {15, 0, 0}},
    {"cloth-funnel-vertex-face.csv", {13, 0, 0}},
    {"erleben-cube-cliff-edges-edge-edge-0.csv", {38, 0, 0}},
    {"erleben-cube-cliff-edges-vertex-face-0.csv", {41, 1, 0}},
    {"erleben-cube-internal-edges-edge-edge-0.csv", {5, 0, 0}},
    {"erleben-cube-internal-edges-vertex-face-0.csv", {9, 0, 0}},
    {"erleben-spikes-edge-edge-0.csv", {17, 0, 0}},
    {"erleben-spikes-vertex-face-0.csv", {10, 0, 0}},
    {"erleben-wedges-edge-edge-0.csv", {7, 0, 0}},
    {"unit-tests-edge-edge-0.csv", {13, 0, 0}},
    {"unit-tests-vertex-face-0.csv", {15, 0, 0}},
};

void expect_shares(const std::string& file, const StageCounters& counters, std::size_t queries) {
  const auto found = ceilings.find(file);
  const Ceilings limit = found == ceilings.end() ? Ceilings{} : found->second;
  const auto percent = [queries](std::uint64_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(queries);
  };
  const std::uint64_t gmp = counters[Stage::gmp], interval = gmp + counters[Stage::interval];
  EXPECT_LE(percent(interval + counters[Stage::fixed]), limit.exact) << file;
  EXPECT_LE(percent(interval), limit.interval) << file;
  EXPECT_LE(percent(gmp), limit.gmp) << file;
}

bool meet_any(QueryKind kind, const QueryRecord& record, StageCounters& counters) {
  return kind == QueryKind::vertex_face ? meet_record<FeaturePair::vertex_face>(record, counters)
                                        : meet_record<FeaturePair::edge_edge>(record, counters);
}

/// Queries that were once answered wrongly, minimised.
TEST(Labels, QueriesOnceAnsweredWrongly) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(NOLI_SOURCE_DIR) / "tests/kernel/queries")) {
    const QueryKind kind = kind_from_file_name(entry.path()).value();
    StageCounters counters;
    for (const QueryRecord& record : read_query_csv(entry.path(), kind)) {
      EXPECT_EQ(meet_any(kind, record, counters), record.label.value()) << entry.path();
    }
    ++files;
  }
  EXPECT_GE(files, 7U);
}

TEST(Labels, AllAgreeAndFewQueriesGetFar) {
  const auto folder = test::real_data("queries");
  if (!folder) GTEST_SKIP() << "no real data";
  std::size_t queries = 0, contacts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    const QueryKind kind = kind_from_file_name(entry.path()).value();
    const auto records = read_query_csv(entry.path(), kind);
    StageCounters counters;
    std::size_t wrong = 0;
    for (const QueryRecord& record : records) {
      const bool answer = meet_any(kind, record, counters);
      wrong += answer != record.label.value();
      contacts += answer;
    }
    EXPECT_EQ(wrong, 0U) << entry.path();
    expect_shares(entry.path().filename().string(), counters, records.size());
    queries += records.size();
  }
  EXPECT_GE(queries, 7186U);
  EXPECT_GT(contacts, 4000U);
}

}  // namespace
}  // namespace noli
