// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/query_corpus.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include <noli/errors.h>
#include "audit/fuzz/queries/fuzz_queries.h"
#include "audit/fuzz/queries/judge.h"
#include "audit/fuzz/queries/query_generators.h"
#include "tests/support/temporary_folder.h"

namespace noli::audit {
namespace {

std::filesystem::path committed_corpus() {
  return std::filesystem::path(NOLI_SOURCE_DIR) / "tests/fuzz/seeds/predicate";
}

/// A vertex that passes through the middle of a face at t = 1/2.
AnyQuery crossing() {
  AnyQuery query{FeaturePair::vertex_face, 3, {}, {}};
  query.x_t0 = {{{0, 0, 1}, {-4, -4, 0}, {4, -4, 0}, {0, 8, 0}}};
  query.x_t1 = query.x_t0;
  query.x_t1[0][2] = -1;
  return query;
}

TEST(QueryCorpus, SignsWhatAQueryReached) {
  EXPECT_EQ(signature(crossing(), Stage::bernstein, ContactKind::crossing, 0.5),
            "vertex_face-3d-bernstein-crossing-inside-1_roots");
  AnyQuery flat = crossing();
  flat.x_t0[0][2] = flat.x_t1[0][2] = 0;
  EXPECT_EQ(signature(flat, Stage::fixed, ContactKind::persistent, 0),
            "vertex_face-3d-fixed-persistent-at_begin-coplanar");
  AnyQuery points{FeaturePair::vertex_vertex, 2, {}, {}};
  EXPECT_EQ(signature(points, Stage::comparison, ContactKind::apart, 0),
            "vertex_vertex-2d-comparison-apart-never-no_orientation");
}

TEST(QueryCorpus, SignsWhatALibraryAnswered) {
  const auto signed_as = [](double time, std::optional<double> exact) {
    LibraryAnswer answer;
    answer.given.state = AnswerState::answered;
    answer.given.code = 1;
    answer.given.time = time;
    return signature_of_answer(answer, exact);
  };
  EXPECT_EQ(signed_as(0.5, 0.5), "hit_exact");
  EXPECT_EQ(signed_as(0.75, 0.5), "hit_late");
  EXPECT_EQ(signed_as(0.25, 0.5), "hit_early_0_bits");
  EXPECT_EQ(signed_as(0.5 - 0x1p-9, 0.5), "hit_early_8_bits");
  EXPECT_EQ(signed_as(0.5 - 0x1p-54, 0.5), "hit_early_48_bits");
  EXPECT_EQ(signed_as(2, 0.5), "hit_bad_time");
  EXPECT_EQ(signed_as(std::numeric_limits<double>::quiet_NaN(), 0.5), "hit_no_time");
  EXPECT_EQ(signed_as(0.5, std::nullopt), "false_hit");
  EXPECT_EQ(signature_of_answer({}, 0.5), "not_asked");
}

TEST(QueryCorpus, ReadsWhatItKept) {
  const test::TemporaryFolder folder;
  QueryCorpus corpus(folder / "corpus");
  EXPECT_TRUE(corpus.queries().empty());
  Random random(1);
  std::vector<SavedQuery> all;
  for (const QueryGenerator& generator : query_generators()) {
    const AnyQuery query = generator(random).query;
    all.push_back({query, make_probe(query, true, random)});
    const std::string name = std::string(noli::name(query.pair)) + "-" + std::to_string(all.size() + 100);
    EXPECT_TRUE(corpus.reached(name));
    EXPECT_FALSE(corpus.reached(name));
    corpus.keep(name, all.back(), true);
  }
  EXPECT_EQ(corpus.kept(), all.size());
  const QueryCorpus again(folder / "corpus");
  ASSERT_EQ(again.queries().size(), all.size());
  for (const CorpusQuery& one : again.queries()) {
    const SavedQuery& saved = all[std::stoul(one.name.substr(one.name.rfind('-') + 1)) - 101];
    EXPECT_EQ(one.saved.query, saved.query) << one.name;
    EXPECT_EQ(one.saved.probe, saved.probe) << one.name;
  }
}

TEST(QueryCorpus, DoesNotWriteOverWhatIsThere) {
  const test::TemporaryFolder folder;
  QueryCorpus corpus(folder / "corpus");
  corpus.keep("vertex_face-a", {crossing(), {}}, true);
  corpus.keep("vertex_face-a", {crossing(), {}}, true);
  EXPECT_EQ(QueryCorpus(folder / "corpus").queries().size(), 2U);
}

TEST(QueryCorpus, SaysWhichFileItCannotRead) {
  const test::TemporaryFolder folder;
  folder.write("some-edge-edge.csv", "no query\n");
  EXPECT_THROW(QueryCorpus(folder / ""), InputError);
}

TEST(SavedQuery, NameAndCommentsHaveToAgree) {
  const test::TemporaryFolder folder;
  const AnyQuery query = crossing();
  save_query(folder / "a-vertex-face.csv", query, true, {});
  EXPECT_EQ(read_saved_queries(folder / "a-vertex-face.csv").at(0).query, query);
  std::filesystem::rename(folder / "a-vertex-face.csv", folder / "a-edge-edge.csv");
  EXPECT_THROW(read_saved_queries(folder / "a-edge-edge.csv"), InputError);
}

TEST(SavedQuery, QuotesForTheShell) {
  EXPECT_EQ(quoted("./mine.so"), "./mine.so");
  EXPECT_EQ(quoted("my library's.so"), "'my library'\\''s.so'");
  EXPECT_EQ(quoted(""), "''");
}

/// Kernel and oracle agree on each committed query. Names state the kind of contact, and all stages and kinds occur.
TEST(CommittedCorpus, KernelAndOracleAgree) {
  const QueryCorpus corpus(committed_corpus());
  ASSERT_GE(corpus.queries().size(), 60U);
  std::set<std::string> reached;
  for (const CorpusQuery& one : corpus.queries()) {
    EXPECT_EQ(replay(one.saved.query, one.saved.probe), std::vector<std::string>()) << one.name;
    StageCounters stages;
    decide_with_kernel(one.saved.query, stages);
    for (const Stage stage : all_stages) {
      if (stages[stage] > 0) reached.insert(std::string(name(stage)));
    }
    const Truth truth = truth_of(one.saved.query);
    EXPECT_NE(one.name.find("-" + std::string(name(truth.kind)) + "-"), std::string::npos) << one.name;
    reached.insert(std::string(name(truth.kind)));
  }
  for (const Stage stage : all_stages) EXPECT_TRUE(reached.contains(std::string(name(stage)))) << name(stage);
  EXPECT_EQ(reached.size(), all_stages.size() + 4);
}

/// The documentation lists each generator with its own description.
TEST(QueryGenerators, AreDocumented) {
  std::ifstream file(std::string(NOLI_SOURCE_DIR) + "/docs/audit/fuzz.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const QueryGenerator& generator : query_generators()) {
    const std::string row = "| `" + std::string(generator.family) + "` | " + std::string(generator.attacks) + " |";
    EXPECT_NE(page.str().find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace noli::audit
