// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli fuzz trajectories --library` on pipelines with and without faults.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <tuple>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

class FuzzLibraryMotions : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "memory of the thread sanitizer grows, which looks like a leak of the library";
#endif
  }

  Words command(const std::string& library, const Words& more) const {
    return Words{"fuzz", "trajectories", "--library", library, "--seed", "1", "--out", folder.path("out")} + more;
  }
  Json json(const std::string& library, int exit_code, const Words& more) const {
    return json_of(command(library, more), exit_code);
  }

  /// The exit code of the command of a finding, as it is or with another library.
  static int again(const std::string& command) {
    return shell(replaced(command, "noli fuzz", std::string(NOLI_COMMAND) + " fuzz")).second;
  }
  static int again(const std::string& command, const std::string& library, const std::string& other) {
    return again(replaced(command, library, other));
  }

  /// A step in which a triangle falls through another one.
  std::string falling_triangle() const {
    const std::string name = folder.path("falling");
    std::filesystem::create_directory(name);
    folder.write("falling/frame-0.ply", two_triangles(1));
    folder.write("falling/frame-1.ply", two_triangles(-1));
    return name;
  }

  Folder folder;
};

TEST_F(FuzzLibraryMotions, FindsNothingInAnExactPipeline) {
  const Json document = json(plugin("noli"), 0, {"--exact", "--tolerance", "0", "--count", "42"});
  EXPECT_EQ(document["verdict"], "no_finding");
  EXPECT_EQ(document["library"], plugin("noli"));
  EXPECT_EQ(document["trajectories"], 42);
  EXPECT_EQ(document["knows_times"], true);
  EXPECT_GT(document["contacts"], 20);
  EXPECT_GT(document["candidates"], document["contacts"]);
  for (const auto& [name, count] : document["faults"].items()) EXPECT_EQ(count, 0) << name;
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
}

TEST_F(FuzzLibraryMotions, AsksTheFamiliesThatAreNamed) {
  const Json document = json(plugin("noli"), 0, {"--family", "huge", "--family", "last_ulp", "--count", "6"});
  ASSERT_EQ(document["generators"].size(), 2U);
  for (const auto& generator : document["generators"]) EXPECT_EQ(generator["motions"], 3);
  EXPECT_EQ(document["generators"][0]["name"], "huge");
}

TEST_F(FuzzLibraryMotions, AsksAboutAllPairsWhereThereIsNoSearch) {
  const Json document = json(faulty("always_hits"), 0, {"--count", "14"});
  const Json with_search = json(plugin("noli"), 0, {"--count", "14"});
  EXPECT_EQ(document["contacts"], with_search["contacts"]);
  EXPECT_GT(document["candidates"], with_search["candidates"]);
}

TEST_F(FuzzLibraryMotions, FindsWhatTheSearchMisses) {
  const Json document = json(faulty("finds_nothing"), 1, {"--count", "14", "--max-findings", "1"});
  EXPECT_EQ(document["faults"]["not_found"], document["findings"]);
  EXPECT_EQ(document["through"], document["findings"]) << "it tells no time at all";
  const Json& finding = document["reports"].at(0);
  EXPECT_EQ(finding["finding"], "not_found");
  EXPECT_EQ(finding["frames"], 2);
  EXPECT_LE(finding["cells"], 2);
  EXPECT_LE(finding["vertices"], 6);
  const std::string where = finding["folder"], readme = read_text(where + "/README"), repeat = finding["command"];
  EXPECT_NE(readme.find(repeat), std::string::npos) << readme;
  EXPECT_EQ(again(repeat), 1);
  EXPECT_EQ(again(repeat, faulty("finds_nothing"), plugin("noli")), 0);
  EXPECT_EQ(again(repeat, faulty("finds_nothing"), faulty("never_hits")), 1) << "for another reason";
}

TEST_F(FuzzLibraryMotions, FindsMissedContactsOfTheTextbookMethodSlow) {
  const Json document = json(plugin("textbook"), 1, {"--count", "140", "--max-findings", "4"});
  EXPECT_GT(document["faults"]["false_negative"], 10);
  EXPECT_EQ(document["faults"]["not_found"], 0) << "its search is right";
  EXPECT_GT(document["through"], 10);
  EXPECT_LT(document["through"], document["findings"]) << "there may be another contact, told in time";
  EXPECT_EQ(document["reports"].size(), 4u);
  for (const Json& finding : document["reports"]) {
    EXPECT_EQ(again(finding["command"]), 1) << finding;
    EXPECT_EQ(again(finding["command"], plugin("textbook"), plugin("noli")), 0) << finding;
  }
}

TEST_F(FuzzLibraryMotions, FindsAMutantThatForgetsTheEndOfAStepSlow) {
  const Json document = json(mutant("end_excluded"), 1, {"--count", "48", "--first-only", "--max-findings", "1"});
  EXPECT_EQ(document["trajectories"], 16) << "the first block";
  EXPECT_EQ(document["reports"][0]["finding"], "false_negative");
  const std::string repeat = document["reports"][0]["command"];
  EXPECT_EQ(again(repeat), 1);
  EXPECT_EQ(again(repeat, mutant("end_excluded"), mutant("none")), 0);
}

TEST_F(FuzzLibraryMotions, GoesOnBehindCrashesAndHangs) {
  add_sanitizer_options("handle_segv=0");
  // Only hangs have a short limit: with sanitizers, some machines take long to end a process that has crashed.
  for (const auto& [library, fault, limit] : {std::tuple{"crashes", "crash", "60s"},
                                              {"ends_the_program", "crash", "60s"},
                                              {"crashes_when_searching", "crash", "60s"},
                                              {"hangs", "hang", "20ms"}}) {
    const Json document = json(faulty(library), 1, {"--count", "28", "--query-limit", limit, "--max-findings", "0"});
    EXPECT_GE(document["faults"][fault], 2) << library;
    EXPECT_EQ(document["trajectories"].get<int>() + document["not_asked"].get<int>(), 28) << library;
    EXPECT_EQ(document["not_asked"].get<int>() > 0, std::string(library) == "hangs") << library;
  }
}

TEST_F(FuzzLibraryMotions, IsUndecidedAboutALibraryThatHasAnsweredNothing) {
  // The first motion of this seed has no candidates; the second one is stopped.
  const Json document = json(faulty("never_answers"), 2, {"--for", "1s", "--threads", "1", "--query-limit", "60s"});
  EXPECT_EQ(document["verdict"], "undecided");
  EXPECT_EQ(document["trajectories"], 1);
  EXPECT_EQ(document["candidates"], 0);
}

TEST_F(FuzzLibraryMotions, MakesACrashAndAHangSmallSlow) {
  for (const char* const library : {"crashes", "hangs"}) {
    const Json document = json(faulty(library), 1, {"--count", "14", "--query-limit", "100ms", "--max-findings", "1"});
    const Json& finding = document["reports"].at(0);
    EXPECT_LE(finding["cells"], 3) << library;
    EXPECT_NE(finding["difference"].get<std::string>().find("asked about"), std::string::npos) << finding;
    EXPECT_NE(finding["command"].get<std::string>().find("--query-limit 100ms"), std::string::npos) << finding;
    EXPECT_EQ(again(finding["command"]), 1) << library;
  }
}

TEST_F(FuzzLibraryMotions, FindsOtherFaultsSlow) {
  for (const auto& [library, fault] : {std::pair{"fails", "failure"},
                                       {"has_wild_times", "not_found"},
                                       {"finds_neighbours", "not_found"},
                                       {"lies_about_time", "late"},
                                       {"leaks", "leak"}}) {
    const Json document = json(faulty(library), 1, {"--count", "51", "--max-findings", "0"});
    EXPECT_GT(document["faults"][fault], 0) << library;
  }
}

TEST_F(FuzzLibraryMotions, TellsFalsePositivesAndEarlyTimesOnlyOfWhatClaimsToBeExact) {
  const Json careful = json(faulty("always_hits"), 0, {"--count", "28"});
  EXPECT_GT(careful["false_positives"], 100);
  const Json exact = json(faulty("always_hits"), 1, {"--count", "28", "--exact", "--max-findings", "0"});
  EXPECT_GT(exact["faults"]["false_positive"], 5);
  const Json early = json(faulty("swept_boxes"), 1, {"--count", "28", "--exact", "--max-findings", "0"});
  EXPECT_GT(early["faults"]["early"].get<int>() + early["faults"]["false_positive"].get<int>(), 5);
}

TEST_F(FuzzLibraryMotions, GivesTheSameForAnyNumberOfThreadsSlow) {
  const auto bytes = [&](const std::string& seed, const std::string& threads) {
    std::filesystem::remove_all(folder.path("out" + seed));  // existing findings would change the names
    return without_timing(
        json_of({"fuzz", "trajectories", "--library", plugin("textbook"), "--count", "20", "--seed", seed, "--threads",
                 threads, "--max-findings", "1", "--out", folder.path("out" + seed)},
                1));
  };
  const std::string one = bytes("5", "1");
  EXPECT_EQ(one, bytes("5", "3"));
  EXPECT_NE(one, bytes("6", "3"));
}

TEST_F(FuzzLibraryMotions, JudgesASavedMotionAndMakesItSmaller) {
  const std::string falling = falling_triangle();
  const Words words = {"fuzz", "trajectories", "--library", faulty("lies_about_time")};
  const Process replayed = run_noli(words + Words{"--replay", falling});
  EXPECT_EQ(replayed.exit_code, 1) << replayed.err;
  EXPECT_NE(
      replayed.out.find("late: step 1: vertex 3 and face 0-1-2: 1, exact first time 0.5 (crossing); a simulation that "
                        "trusts it goes through the contact\n"),
      std::string::npos)
      << replayed.out;
  const Json smaller = json_of(words + Words{"--minimise", falling, "--out", folder.path("out")}, 1);
  EXPECT_EQ(smaller["folder"], folder.path("out/falling-minimised"));
  EXPECT_LE(smaller["vertices"], 6);
  EXPECT_EQ(run_noli(words + Words{"--replay", smaller["folder"]}).exit_code, 1);
  const Process right = run_noli({"fuzz", "trajectories", "--library", plugin("noli"), "--replay", falling});
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(right.verdict_line(), "NO FINDING  frames 2, cells 2, vertices 6");
}

TEST_F(FuzzLibraryMotions, SaysWhereItCrashed) {
  add_sanitizer_options("handle_segv=0");
  const std::string falling = falling_triangle();
  const auto words = [&](const std::string& library) {
    return json_of({"fuzz", "trajectories", "--library", faulty(library), "--replay", falling}, 1)["difference"]
        .get<std::string>();
  };
  EXPECT_EQ(words("crashes_when_searching"),
            "crash: step 1: signal 11 (Segmentation fault), in the search for candidates");
  EXPECT_EQ(
      words("fails"),
      "failure: step 1: vertex 3 and face 0-1-2: exact first time 0.5 (crossing); a simulation that trusts it goes "
      "through the contact");
}

TEST_F(FuzzLibraryMotions, DoesNotSayWhereWhenNobodyKnows) {
  const Json document = json(faulty("writes_zeros_and_crashes"), 1, {"--count", "14", "--max-findings", "1"});
  EXPECT_GT(document["faults"]["crash"], 0);
  const std::string words = document["reports"][0]["difference"];
  EXPECT_NE(words.find("at an unknown place"), std::string::npos) << words;
}

TEST_F(FuzzLibraryMotions, LeavesNoPartOfAFindingWhereThereIsNoRoom) {
  std::string out = folder.path("out");  // long enough that a folder of findings fits, but no file in it
  while (out.size() < 3900) out += "/" + std::string(100, 'x');
  out += "/" + std::string(4045 - out.size(), 'x');
  std::filesystem::create_directories(out);
  const Process process = run_noli({"fuzz", "trajectories", "--library", faulty("never_hits"), "--count", "14",
                                    "--max-findings", "2", "--out", out});
  EXPECT_EQ(process.exit_code, 4) << process.err.substr(0, 200);
  EXPECT_TRUE(std::filesystem::is_empty(out));
  EXPECT_NE(process.out.find("not saved"), std::string::npos) << process.out;
}

TEST_F(FuzzLibraryMotions, RunsItsCorpusFirst) {
  const Words more = {"--count", "14", "--corpus", folder.path("corpus")};
  const Json first = json(plugin("noli"), 0, more), second = json(plugin("noli"), 0, more);
  EXPECT_GT(first["corpus"], 5);
  EXPECT_EQ(first["corpus"], second["corpus"]) << "nothing of it was new";
  EXPECT_GT(second["contacts"], first["contacts"]);
  const Json other = json(faulty("never_hits"), 1, more + Words{"--first-only", "--max-findings", "1"});
  EXPECT_EQ(other["trajectories"], 0);
  EXPECT_EQ(other["reports"][0]["generator"].get<std::string>().substr(0, 7), "corpus/");
}

TEST_F(FuzzLibraryMotions, KeepsFindingsWhenInterrupted) {
  expect_findings_kept(command(faulty("never_hits"), {"--for", "10m"}), std::chrono::milliseconds(1000));
}

TEST_F(FuzzLibraryMotions, RefusesWhatCannotBe) {
  const auto refused = [](const Words& words, const std::string& because) {
    expect_refused(Words{"fuzz", "trajectories"} + words, because);
  };
  const std::string falling = falling_triangle();
  refused({"--library", faulty("has_no_query"), "--count", "1"}, "has no visible function noli_ccd_query");
  refused({"--library", faulty("has_another_version"), "--count", "1"}, "is for version 2");
  refused({"--library", faulty("crashes_when_loaded"), "--count", "1"}, "cannot be loaded");
  refused({"--library", folder.path("absent.so"), "--count", "1"}, "absent.so");
  refused({"--library", folder.path("absent.so"), "--replay", falling}, "absent.so");
  refused({"--library", plugin("noli"), "--replay", folder.path("absent")}, "absent");
  refused({"--library", plugin("noli"), "--replay", falling, "--json", falling + "/frame-0.ply"}, "is also an input");
  refused({"--library", plugin("noli"), "--replay", falling, "--first-only"}, "--first-only");
  refused({"--library", plugin("noli"), "--count", "1", "--verified-every", "2"}, "--verified-every");
  refused({"--library", plugin("noli"), "--replay", falling, "--family", "landing"}, "--family");
  refused({"--library", plugin("noli"), "--count", "1", "--tolerance", "-1"}, "--tolerance");
  refused({"--count", "1", "--exact"}, "--library");
  refused({"--count", "1", "--query-limit", "1s"}, "--library");
}

TEST_F(FuzzLibraryMotions, TheWorkedExampleIsTrue) {
  const auto commands = worked_example("docs/audit/fuzz-trajectories.md", "## Another library");
  ASSERT_GE(commands.size(), 3u);
  expect_worked_example(commands, {{"build/release/app/noli", NOLI_COMMAND},
                                   {"build/release/audit/ccd/plugins", NOLI_CCD_PLUGINS},
                                   {"build/findings", folder.path("findings")}});
}

TEST_F(FuzzLibraryMotions, NothingIsFoundInAnExactPipelineWithinHundredsOfMotionsSlow) {
  const Json document = json(plugin("noli"), 0, {"--count", "1400", "--exact", "--tolerance", "0"});
  EXPECT_EQ(document["trajectories"], 1400);
  EXPECT_EQ(json(mutant("none"), 0, {"--count", "42", "--exact"})["trajectories"], 42) << "and it has no search";
}

}  // namespace
}  // namespace noli::app_tests
