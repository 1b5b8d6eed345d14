// SPDX-License-Identifier: Apache-2.0
//
// Tests how an answer takes its key-value pairs from the members of a result.
#include <gtest/gtest.h>

#include "report/answer.h"

namespace noli::app_tests {
namespace {

using report::Answer;

std::string pairs(const Json& members, const std::vector<std::string>& names) {
  Json result = {{"verdict", "no_finding"}};
  result.update(members);
  const std::string line = Answer(result, names).porcelain(), begin = "verdict=no_finding ";
  EXPECT_TRUE(line.starts_with(begin) && line.ends_with('\n')) << line;
  return line.substr(begin.size(), line.size() - begin.size() - 1);
}

TEST(Answer, TakesNumbersAndWordsAsTheyAre) {
  EXPECT_EQ(pairs({{"items", 12}, {"ended", true}, {"name", "cloth"}}, {"items", "ended", "name"}),
            "items=12 ended=true name=cloth");
}

TEST(Answer, KeepsEveryBitOfANumber) { EXPECT_EQ(pairs({{"time", 0.1}}, {"time"}), "time=0.10000000000000001"); }

TEST(Answer, TakesTheLengthOfAnArray) {
  EXPECT_EQ(pairs({{"rows", {5, 6, 7}}, {"empty", Json::array()}}, {"rows", "empty"}), "rows=3 empty=0");
}

TEST(Answer, SaysNoneWhereThereIsNothing) {
  EXPECT_EQ(pairs({{"first", nullptr}, {"saved", ""}}, {"first", "saved"}), "first=none saved=none");
}

TEST(Answer, TakesMembersOfMembersUnderAnotherName) {
  EXPECT_EQ(pairs({{"codes", {{"accepted", 4}}}}, {"ok=codes/accepted"}), "ok=4");
}

TEST(Answer, QuotesWhatHasBlanks) { EXPECT_EQ(pairs({{"file", "a \"b\".ply"}}, {"file"}), "file=\"a 'b'.ply\""); }

TEST(Answer, NeedsItsMembers) {
  EXPECT_THROW(Answer(Json{{"verdict", "contact"}}, {"items"}), Json::exception);
  EXPECT_THROW(Answer(Json{{"items", 1}}, {"items"}), Json::exception);
}

TEST(Answer, EndsWithTheVerdictInCapitalsAndItsPairs) {
  const Answer answer(Json{{"verdict", "no_finding"}, {"items", 2}, {"seed", 7}}, {"items", "seed"});
  EXPECT_EQ(answer.last_line(), "NO FINDING  items 2, seed 7");
}

}  // namespace
}  // namespace noli::app_tests
