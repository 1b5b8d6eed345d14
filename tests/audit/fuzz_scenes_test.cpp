// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/scenes/fuzz_scenes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"
#include "trajectory/write_file.h"

namespace noli::audit {
namespace {

ProgramEnd ended(int code, std::string out = "", std::string err = "") {
  return {ProgramEnd::Kind::exited, code, std::move(out), std::move(err)};
}

SceneJson scene_of(const std::vector<std::string>& arguments) {
  std::ifstream file(arguments[1]);
  return SceneJson::parse(file);
}

bool has(const std::vector<std::string>& arguments, const std::string& word) {
  return std::ranges::find(arguments, word) != arguments.end();
}

/// A program that does everything right and accepts every scene.
ProgramEnd does_well(const std::vector<std::string>& arguments) {
  if (arguments[0] != "simulate") return ended(0, "verdict=proved\n");
  const std::filesystem::path run = arguments[3];
  std::filesystem::create_directories(run);
  write_file(run / "trajectory.blocks", scene_of(arguments).dump());
  write_file(run / "proof.blocks", "proof");
  return ended(0, "verdict=no_contact end=done windows=2 windows_total=2\n");
}

class FuzzScenes : public testing::Test {
 protected:
  FuzzScenes() {
    options.limits.seed = 1;
    options.limits.count = 22;
    options.limits.threads = 1;
    options.out = folder / "out";
    options.max_findings = 1;
  }

  /// The first finding that is not about an invalid scene.
  std::optional<SceneFinding> finding_of(const RunNoli& noli) {
    options.noli = noli;
    for (SceneFinding& finding : fuzz_scenes(options).findings) {
      if (finding.generator != "invalid") return finding;
    }
    return std::nullopt;
  }

  test::TemporaryFolder folder;
  SceneFuzzOptions options;
};

TEST_F(FuzzScenes, FindsNothingInValidScenesWhereNothingIsWrong) {
  options.limits.count = 11;  // all generators except that of invalid scenes
  options.noli = does_well;
  const SceneFuzzReport report = fuzz_scenes(options);
  EXPECT_EQ(report.findings_total, 0u) << report.findings[0].difference;
  EXPECT_EQ(report.resumed, 11u);
  EXPECT_FALSE(std::filesystem::exists(options.out));
}

TEST_F(FuzzScenes, KeepsOneSceneOfEachShapeAndJudgesThemFirst) {
  options.limits.count = 11;
  options.noli = does_well;
  options.corpus = folder / "corpus";
  std::filesystem::create_directory(*options.corpus);
  EXPECT_EQ(fuzz_scenes(options).corpus_size, 11u) << "all end alike, but are of different generators";
  EXPECT_EQ(fuzz_scenes(options).corpus_size, 11u);

  options.limits.count = 1;
  options.noli = [](const std::vector<std::string>&) { return ended(4, "", "noli: out of memory"); };
  const SceneFuzzReport report = fuzz_scenes(options);
  EXPECT_EQ(report.findings_total, 12u);
  EXPECT_TRUE(report.findings[0].generator.starts_with("corpus/shape-")) << report.findings[0].generator;
  EXPECT_TRUE(std::filesystem::exists(report.findings[0].place));
}

TEST_F(FuzzScenes, AWrongSceneThatIsAcceptedIsAFinding) {
  options.limits.count = 12;
  options.noli = does_well;
  const SceneFuzzReport report = fuzz_scenes(options);
  ASSERT_EQ(report.findings_total, 1u);
  EXPECT_TRUE(report.findings[0].difference.starts_with("accepted: /")) << report.findings[0].difference;
}

TEST_F(FuzzScenes, APlaceIsNotNamedByALongerNumber) {
  const GeneratedScene wrong{SceneJson::object(), "/bodies/1"};
  const auto refusing = [](const char* place) {
    return [place](const std::vector<std::string>& arguments) {
      return ended(3, "", "noli: " + arguments[1] + ": " + place + ": expected something else");
    };
  };
  const auto judged = [&](const char* place) { return judge_scene(wrong, refusing(place)).difference; };
  EXPECT_FALSE(judged("/bodies/1"));
  EXPECT_FALSE(judged("/bodies/1/mesh"));
  EXPECT_TRUE(judged("/bodies/10"));
  EXPECT_TRUE(judged("/bodies"));
}

TEST_F(FuzzScenes, ASavedSceneHasNotAnyDepth) {
  const auto nested = [&](std::size_t levels) {
    write_file(folder / "deep.json", std::string(levels, '[') + std::string(levels, ']'));
    return folder / "deep.json";
  };
  EXPECT_NO_THROW(read_saved_scene(nested(60)));
  EXPECT_THROW(read_saved_scene(nested(100'000)), InputError);
}

TEST_F(FuzzScenes, AMessageHasToNameThePlace) {
  GeneratedScene wrong{{{"noli_scene", 1}}, "/bodies/0/mesh"};
  const auto judged = [&](const std::string& message) {
    return judge_scene(wrong, [&](const std::vector<std::string>&) { return ended(3, "", message); });
  };
  EXPECT_EQ(judged("noli: scene.json: /bodies/0/mesh: expected another").difference, std::nullopt);
  EXPECT_TRUE(judged("noli: scene.json: something is wrong").difference.value().starts_with("message: "));
}

TEST_F(FuzzScenes, MakesAFailingSceneSmall) {
  const auto finding = finding_of([](const std::vector<std::string>& arguments) {
    const bool fails = arguments[0] == "simulate" && scene_of(arguments).contains("gravity");
    return fails ? ended(4, "", "internal error") : does_well(arguments);
  });
  ASSERT_TRUE(finding.has_value());
  EXPECT_EQ(finding->difference, "failure: noli simulate: exit code 4: internal error");
  EXPECT_EQ(finding->shrunk.size(), 1u) << finding->shrunk.dump();
  EXPECT_TRUE(finding->shrunk.contains("gravity"));
  std::ifstream saved(finding->place);
  EXPECT_EQ(SceneJson::parse(saved), finding->shrunk);
}

TEST_F(FuzzScenes, ASavedSceneIsMadeSmallerIfSomethingIsWrong) {
  const SceneJson scene = {{"noli_scene", 1}, {"gravity", {0, 0, -1}}, {"window", 0.5}};
  const RunNoli fails = [](const std::vector<std::string>& arguments) {
    return arguments[0] == "simulate" && scene_of(arguments).contains("gravity") ? ended(4, "", "internal error")
                                                                                 : does_well(arguments);
  };
  const ReplayedScene as_it_is = replay_scene({scene, std::nullopt}, false, fails);
  EXPECT_EQ(as_it_is.scene, scene);
  EXPECT_EQ(as_it_is.judgement.difference, "failure: noli simulate: exit code 4: internal error");
  const ReplayedScene smaller = replay_scene({scene, std::nullopt}, true, fails);
  EXPECT_EQ(smaller.scene.size(), 1U) << smaller.scene.dump();
  EXPECT_EQ(smaller.judgement.difference, as_it_is.judgement.difference);
  const ReplayedScene good = replay_scene({scene, std::nullopt}, true, does_well);
  EXPECT_EQ(good.scene, scene);
  EXPECT_EQ(good.judgement.difference, std::nullopt);
}

TEST_F(FuzzScenes, FindsEveryKindOfWrongEnd) {
  struct Fault {
    const char* kind;
    ProgramEnd (*noli)(const std::vector<std::string>&);
  };
  const std::vector<Fault> faults = {
      {"verdict",
       [](const std::vector<std::string>& a) {
         return a[0] == "simulate" ? ended(0, "verdict=contact end=contact windows=2\n") : does_well(a);
       }},
      {"verify",
       [](const std::vector<std::string>& a) {
         return a[0] == "verify" ? ended(1, "verdict=contact\n") : does_well(a);
       }},
      {"check",
       [](const std::vector<std::string>& a) {
         return a[0] == "check" ? ended(3, "verdict=rejected\n") : does_well(a);
       }},
      {"resume",
       [](const std::vector<std::string>& a) {
         const ProgramEnd end = does_well(a);
         if (has(a, "--resume")) write_file(std::filesystem::path(a[3]) / "trajectory.blocks", "other bytes");
         return end;
       }},
      {"failure",
       [](const std::vector<std::string>& a) {
         return a[0] == "verify" ? ProgramEnd{ProgramEnd::Kind::signalled, 11, "", ""} : does_well(a);
       }},
      {"failure",
       [](const std::vector<std::string>&) {
         return ProgramEnd{ProgramEnd::Kind::hung, 0, "", ""};
       }},
      {"message", [](const std::vector<std::string>&) { return ended(3, "", "no"); }},
  };
  options.shrink_budget = 3;
  for (const Fault& fault : faults) {
    const auto finding = finding_of(fault.noli);
    ASSERT_TRUE(finding.has_value()) << fault.kind;
    EXPECT_EQ(finding->difference.substr(0, finding->difference.find(':')), fault.kind) << finding->difference;
  }
}

TEST(SceneGenerators, DependOnTheirRandomNumbersAlone) {
  for (const SceneGenerator& generator : scene_generators()) {
    Random one(5), same(5), other(6);
    const std::string text = generator.make(one).scene.dump();
    EXPECT_EQ(text, generator.make(same).scene.dump()) << generator.name;
    EXPECT_NE(text, generator.make(other).scene.dump()) << generator.name;
  }
}

TEST(RunProgram, TellsHowItEnded) {
  const auto run = [](const std::string& script) {
    ProgramLimits limits;
    limits.time = std::chrono::milliseconds(500);
    return run_program({"/bin/sh", "-c", script}, limits);
  };
  const ProgramEnd end = run("echo out; echo err >&2; exit 3");
  EXPECT_TRUE(end.exited_with(3));
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.err, "err\n");
  EXPECT_EQ(run("kill -SEGV $$").kind, ProgramEnd::Kind::signalled);
  EXPECT_EQ(run("sleep 60").kind, ProgramEnd::Kind::hung);
  EXPECT_THROW(run_program({"/no/such/program"}, {}), std::runtime_error);
}

/// A process is stopped (Ctrl-Z) while its program runs. The test forks a process for this: if the test itself were
/// stopped, the shell would treat its job as stopped.
TEST(RunProgram, DoesNotCountATimeInWhichItWasStoppedItself) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ProgramLimits limits;
    limits.time = std::chrono::seconds(3);
    const ProgramEnd end =
        run_program({"/bin/sh", "-c", "kill -STOP $PPID; sleep 4; kill -CONT $PPID; sleep 0.1; exit 3"}, limits);
    _exit(end.exited_with(3) ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(RunProgram, WritesWordsAsAShellReadsThem) {
  EXPECT_EQ(shell_words({"noli", "a b", "it's", ""}), "noli 'a b' 'it'\\''s' ''");
}

}  // namespace
}  // namespace noli::audit
