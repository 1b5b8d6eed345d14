// SPDX-License-Identifier: Apache-2.0
//
// Tests how an answer takes its key-value pairs from the members of a result, and the answers about simulations,
// reproduced windows and exports.
#include <gtest/gtest.h>

#include "report/answer.h"
#include "report/figures/export_report.h"
#include "report/simulate_report.h"

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

TEST(ReproduceAnswer, SaysWhetherTheWindowIsThatOfTheRun) {
  const ReproduceRequest request{.scene = "scene.json", .run = "run", .window = 3, .output = "three.block"};
  ReproduceOutcome outcome{.same = true, .breakpoints = 12};
  const auto answered = [&] {
    const Json json = report::reproduce_json(request, outcome);
    const Answer answer = report::reproduce_answer(json, request);
    return answer.text + answer.porcelain();
  };
  const std::string hash = ", SHA-256 " + std::string(64, '0') + ", is in three.block.\n";
  EXPECT_EQ(answered(), "The window of the run" + hash + "verdict=same window=3 breakpoints=12\n");
  outcome.same = false;
  EXPECT_EQ(answered(), "A different window from the run's" + hash + "verdict=different window=3 breakpoints=12\n");
}

TEST(SimulateAnswer, RepeatsTheOptionsThatDecideWhatIsSimulated) {
  SimulateRequest request;
  request.scene = "my scene.json";
  request.run = "run/";
  SimulateOutcome outcome;
  outcome.end = RunEnd::out_of_time;
  const auto next = [&] {
    return report::simulate_answer(report::simulate_json(request, outcome), request, outcome).next;
  };
  EXPECT_EQ(next(), "noli simulate 'my scene.json' -o run --resume");
  request.brief = request.past_duration = request.ignore_space = request.force = true;
  request.prove = false;
  request.until = 0.1;
  const std::string all = "noli simulate 'my scene.json' --short -o run --until 0.1 --past-duration --ignore-space";
  EXPECT_EQ(next(), all + " --resume") << "what --no-proof and --force did is done";
  outcome.begun = false;
  EXPECT_EQ(next(), all + " --no-proof --force");
}

TEST(SimulateAnswer, NamesTheFieldThatAcceptsStepsThatAreTooLong) {
  SimulateRequest request;
  request.scene = "scene.json";
  request.brief = true;
  SimulateOutcome outcome;
  outcome.energy_astray = EnergyAstray{};
  outcome.limit = PairTooNear{};
  outcome.not_finite = NotFinite{};
  for (const RunEnd end : {RunEnd::unstable, RunEnd::not_finite, RunEnd::too_near}) {
    outcome.end = end;
    const auto next = [&](bool allow_unstable) {
      outcome.allow_unstable = allow_unstable;
      return report::simulate_answer(report::simulate_json(request, outcome), request, outcome).next;
    };
    EXPECT_EQ(next(true),
              "remove \"allow_unstable\" from scene.json; noli explain scene.json --short then names any step that is "
              "too long.");
    EXPECT_EQ(next(false).find("allow_unstable"), std::string::npos) << name(end);
  }
}

TEST(ExportAnswer, SaysWhatIsSpecialAboutTheRun) {
  const ExportRequest request{.run = "run", .pattern = "frames/%d.vtu"};
  ExportOutcome outcome{.frames = 4, .windows = 2, .end = 0.5, .pvd = "frames/frames.pvd"};
  const std::string lines =
      "Straight lines between these frames are not the certified motion; the world lines of the run are.\n";
  Answer answer = report::export_answer(request, outcome);
  EXPECT_EQ(answer.text, "ParaView opens the series: frames/frames.pvd\n" + lines);
  EXPECT_EQ(answer.place, "frames/%d.vtu  4 frames of 2 windows, up to 0.5 s");
  EXPECT_EQ(answer.verdict(), "written");
  outcome = {.frames = 4,
             .windows = 2,
             .end = 0.5,
             .pvd = "",
             .removed = 3,
             .open_window = true,
             .interrupted = true,
             .recorded = true};
  answer = report::export_answer(request, outcome);
  EXPECT_EQ(answer.text,
            "Removed: 3 files of an earlier export.\n"
            "The run recorded frames: these were written, at the scene's frame_rate, not at --fps.\n"
            "The run ends in a window that was never committed; it is left out.\n" +
                lines);
  EXPECT_EQ(answer.verdict(), "interrupted");
}

}  // namespace
}  // namespace noli::app_tests
