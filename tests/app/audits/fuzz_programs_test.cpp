// SPDX-License-Identifier: Apache-2.0
//
// Tests the user's view of `noli fuzz trajectories`, `noli fuzz proofs` and `noli fuzz scenes`. tests/audit tests with
// planted faults that they find what is wrong.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

Arguments with(Arguments words, const Arguments& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const char* const ring_scene =
    R"({"noli_scene": 1, "dimension": 2, "duration": 0.02, "bodies": [{"mesh": {"ring": {"radius": 1, "segments": 5}},
        "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}]})";

const std::vector<Arguments> commands = {
    {"fuzz", "trajectories", "--seed", "5", "--count", "28"},
    {"fuzz", "proofs", "--seed", "5", "--count", "1500"},
    {"fuzz", "scenes", "--seed", "5", "--count", "4"},
};

TEST(FuzzPrograms, FindNothingAndDependOnTheSeedAlone) {
  const Folder folder;
  for (const Arguments& command : commands) {
    const auto run = [&](const char* threads) {
      return without_timing(json_of(with(command, {"--threads", threads, "--out", folder.path("out")}), 0));
    };
    const std::string one = run("1");
    EXPECT_EQ(Json::parse(one)["verdict"], "no_finding") << command[1];
    EXPECT_EQ(one, run("2")) << command[1];
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(FuzzPrograms, RefuseWhatCannotBe) {
  const Folder folder;
  const std::string file = folder.write("file", "text");
  const std::vector<Arguments> lines = {
      {"fuzz", "trajectories", "--count", "0"},
      {"fuzz", "trajectories", "--for", "soon"},
      {"fuzz", "trajectories", "--replay", folder.path("absent")},
      {"fuzz", "trajectories", "--replay", folder.path(""), "--seed", "1"},
      {"fuzz", "trajectories", "--count", "1", "--out", file},
      {"fuzz", "trajectories", "--count", "1", "--corpus", file},
      {"fuzz", "proofs", "--count", "1", "--out", file},
      {"fuzz", "proofs", "--count", "1", "--corpus", file},
      {"fuzz", "proofs", file, "--count", "1"},
      {"fuzz", "proofs", file, folder.path("absent.ply"), "--count", "1"},
      {"fuzz", "scenes", "--seed", "-1"},
      {"fuzz", "scenes", "--replay", file},
      {"fuzz", "scenes", "--replay", file, "--minimise", file},
      {"fuzz", "scenes", "--count", "1", "--out", file},
      {"fuzz", "scenes", "--count", "1", "--corpus", file},
  };
  for (const Arguments& line : lines) {
    const Process process = run_noli(line);
    EXPECT_EQ(process.exit_code, 3) << line[1] << " " << line.back() << ": " << process.out << process.err;
    EXPECT_EQ(process.err.rfind("noli: ", 0), 0u) << process.err;
  }
}

/// Permissions do not tell: root has them all, but cannot create files in /proc either.
TEST(FuzzPrograms, KnowBeforeTheyBeginWhereNoFileCanBeMade) {
  for (const char* const what : {"queries", "trajectories", "proofs", "scenes"}) {
    for (const char* const option : {"--corpus", "--out"}) {
      for (const char* const folder : {"/proc", "/proc/none"}) {
        const Process process = run_noli({"fuzz", what, "--count", "1", option, folder});
        EXPECT_EQ(process.exit_code, 3) << what << option << folder << process.out << process.err;
        EXPECT_EQ(process.out, "");
        EXPECT_EQ(process.err.rfind(std::string("noli: error: ") + option + " " + folder + ": cannot be ", 0), 0u)
            << process.err;
      }
    }
  }
}

TEST(FuzzPrograms, StopWhenInterrupted) {
  const Folder folder;
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(700);
  for (const char* const what : {"trajectories", "scenes", "proofs"}) {
    const Process process = run_noli({"fuzz", what, "--for", "10m", "--out", folder.path("out")}, options);
    EXPECT_EQ(process.exit_code, 2) << what << ": " << process.out << process.err;
  }
}

TEST(FuzzPrograms, DoNotOverwriteWhatTheyReplay) {
  const Folder folder;
  const std::string frame = folder.write("frame-0.ply", two_triangles(1));
  folder.write("frame-1.ply", two_triangles(1));
  const std::string trajectory = folder.write("trajectory-0.ply", two_triangles(1));
  const std::string proof = folder.write("proof.noli", "no proof");
  const std::vector<std::pair<const char*, std::string>> lines = {
      {"trajectories", frame}, {"proofs", proof}, {"proofs", trajectory}};
  for (const auto& [what, file] : lines) {
    for (const char* const option : {"--replay", "--minimise"}) {
      const auto before = std::filesystem::file_size(file);
      const Process process = run_noli({"fuzz", what, option, folder.path(""), "--json", file});
      EXPECT_EQ(process.exit_code, 3) << file << process.out;
      EXPECT_NE(process.err.find("is also an input"), std::string::npos) << process.err;
      EXPECT_EQ(std::filesystem::file_size(file), before);
    }
  }
}

TEST(FuzzPrograms, SayThatTheirCheckersAreNotThere) {
  const Folder folder;
  std::filesystem::copy_file(NOLI_COMMAND, folder.path("noli"));
  ProcessOptions alone;
  alone.program = folder.path("noli");
  for (const char* const what : {"trajectories", "proofs", "scenes"}) {
    const Process process = run_noli({"fuzz", what, "--count", "2", "--out", folder.path("out")}, alone);
    EXPECT_EQ(process.exit_code, 4) << what << ": " << process.out << process.err;
    EXPECT_NE(process.err.find("cannot be started: No such file"), std::string::npos) << process.err;
  }
}

TEST(FuzzProofsCommand, IsUndecidedWhenItIsInterruptedBeforeItBegins) {
  const Folder folder;
  std::filesystem::copy_file(NOLI_COMMAND, folder.path("noli"));
  std::filesystem::permissions(folder.write("noli_check", "#!/bin/sh\nsleep 60\n"), std::filesystem::perms::owner_all);
  ProcessOptions options;
  options.program = folder.path("noli");
  options.signal = SIGINT;
  const std::string a = folder.write("a.ply", two_triangles(1));
  for (const Arguments& files : {Arguments{}, Arguments{a, a}}) {
    for (const int milliseconds : {0, 500}) {
      options.signal_after = std::chrono::milliseconds(milliseconds);
      const Process process =
          run_noli(with({"fuzz", "proofs", "--for", "10m", "--out", folder.path("out")}, files), options);
      EXPECT_EQ(process.exit_code, 2) << process.err;
      EXPECT_TRUE(process.verdict_line().starts_with("UNDECIDED  mutants 0, ")) << process.out << process.err;
    }
  }
}

/// A copy of noli whose verified checker is `program`.
ProcessOptions with_verified_checker(const Folder& folder, const char* program) {
  namespace fs = std::filesystem;
  for (const char* const name : {"noli", "noli_check", "noli_check_host"}) {
    fs::copy_file(fs::path(NOLI_COMMAND).parent_path() / name, folder.path(name));
  }
  fs::permissions(folder.write("noli_check_verified", program), fs::perms::owner_all);
  ProcessOptions options;
  options.program = folder.path("noli");
  return options;
}

const char* const takes_nothing = "#!/bin/sh\nexit 3\n";

/// Interrupts a fuzzer that runs long and has certain findings at its beginning. They must be reported, and saved with
/// the command that replays them.
class FindingsKept : public testing::Test {
 protected:
  void expect_kept(const Arguments& words, const std::string& saved) {
    options.signal = SIGINT;
    options.signal_after = std::chrono::milliseconds(3000);
    const Process process = run_noli(with(words, {"--for", "10m", "--threads", "1", "--out", out}), options);
    EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
    EXPECT_EQ(process.verdict_line().rfind("UNDECIDED ", 0), 0u) << process.out;
    EXPECT_EQ(process.verdict_line().find(" findings 0,"), std::string::npos) << process.out;
    EXPECT_NE(process.out.find("saved as " + out + "/"), std::string::npos) << process.out;
    EXPECT_EQ(process.out.find("not saved"), std::string::npos) << process.out;
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
      if (entry.path().filename() != saved) continue;
      ++found;
      EXPECT_NE(read_text(entry.path().parent_path() / "README").find("--replay"), std::string::npos) << entry.path();
    }
    EXPECT_GE(found, 1u) << process.out;
  }

  const Folder folder{};
  const std::string out = folder.path("out"), corpus = folder.path("corpus");
  ProcessOptions options;
};

TEST_F(FindingsKept, OfProofs) {
  const std::string a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(0.5));
  const std::string proof = folder.path("ab.noli");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof}).exit_code, 0);
  options = with_verified_checker(folder, takes_nothing);
  expect_kept({"fuzz", "proofs", proof, a, b, "--verified-every", "1"}, "proof.noli");
}

TEST_F(FindingsKept, OfTrajectories) {
  namespace fs = std::filesystem;
  fs::create_directory(corpus);
  fs::copy(fs::path(NOLI_SOURCE_DIR) / "tests/audit/motions/apart", corpus + "/apart");
  options = with_verified_checker(folder, takes_nothing);
  expect_kept({"fuzz", "trajectories", "--corpus", corpus}, "frame-0.ply");
}

/// The corpus claims an error at a place where the scene is right.
TEST_F(FindingsKept, OfScenes) {
  std::filesystem::create_directories(corpus + "/ring");
  folder.write("corpus/ring/scene.json", ring_scene);
  folder.write("corpus/ring/wrong_place", "/bodies/0/mesh\n");
  folder.write("corpus/ring/shape", "ring\n");
  expect_kept({"fuzz", "scenes", "--corpus", corpus}, "scene.json");
}

TEST(FuzzTrajectoriesCommand, RunsItsCorpusFirst) {
  const Folder folder;
  const Arguments command = {"fuzz",     "trajectories",        "--count", "14",
                             "--corpus", folder.path("corpus"), "--out",   folder.path("out")};
  const Json first = json_of(command, 0), again = json_of(command, 0);
  EXPECT_GT(first["corpus"], 5);
  EXPECT_EQ(first["corpus"], again["corpus"]) << "nothing of it was new";
}

TEST(FuzzTrajectoriesCommand, JudgesASavedMotionAgain) {
  const Folder folder;
  folder.write("frame-0.ply", two_triangles(1));
  folder.write("frame-1.ply", two_triangles(-1));
  const Process process = run_noli({"fuzz", "trajectories", "--replay", folder.path("")});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line(), "NO FINDING  frames 2, cells 2, vertices 6");
}

TEST(FuzzProofsCommand, TakesAProofOfYourOwn) {
  const Folder folder;
  const std::string a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(0.5));
  const std::string proof = folder.path("ab.noli");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof}).exit_code, 0);
  const Json document = json_of({"fuzz", "proofs", proof, a, b, "--count", "2000", "--out", folder.path("out")}, 0);
  EXPECT_EQ(document["mutants"], 2000);
  EXPECT_GT(document["codes"]["accepted"], 0);
  EXPECT_GT(document["judged"], 0);
  folder.write("a.ply", two_triangles(2));
  EXPECT_EQ(run_noli({"fuzz", "proofs", proof, a, b, "--count", "10"}).exit_code, 3) << "a proof of something else";
}

TEST(FuzzProofsCommand, KeepsAndReplaysWhatReachedSomethingNew) {
  const Folder folder;
  const std::string a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(0.5));
  const std::string proof = folder.path("ab.noli"), corpus = folder.path("corpus");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof}).exit_code, 0);
  const std::vector<std::string> words = {"fuzz", "proofs",    proof, a,          b,     "--count",
                                          "512",  "--threads", "1",   "--corpus", corpus};
  const Json document = json_of(words, 0);
  EXPECT_GT(document["corpus"], 10);
  std::set<std::string> said;
  const bool verified = verified_checker_is_there();
  for (const auto& kept : std::filesystem::directory_iterator(corpus)) {
    const Json again = json_of({"fuzz", "proofs", "--replay", kept.path().string()}, 0);
    EXPECT_EQ(again["verdict"], "no_finding");
    EXPECT_EQ(again["verified"], verified ? again["plain"] : Json("not_asked"));
    EXPECT_EQ(again["claim"] != "not_judged", again["plain"] != "rejected");
    said.insert(again["plain"]);
  }
  EXPECT_TRUE(said.count("accepted") == 1 && said.count("rejected") == 1);
}

TEST(FuzzPrograms, RefuseToReplayFramesWithAGapOrTwice) {
  const Folder folder;
  const std::vector<std::pair<const char*, std::string>> names = {{"proofs", "trajectory-"},
                                                                  {"trajectories", "frame-"}};
  for (const auto& [fuzzer, frame] : names) {
    const auto refusal = [&folder, command = fuzzer] {
      const Process process = run_noli({"fuzz", command, "--replay", folder.path("")});
      EXPECT_EQ(process.exit_code, 3) << process.out;
      return process.err;
    };
    folder.write("proof.noli", "no proof");
    folder.write(frame + "0.ply", two_triangles(1));
    folder.write(frame + "2.ply", two_triangles(1));
    const std::string gap = "has " + frame + "2.ply, but no " + frame + "1.ply";
    EXPECT_NE(refusal().find(gap), std::string::npos) << refusal();
    folder.write(frame + "1.ply", two_triangles(1));
    folder.write(frame + "0.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
    EXPECT_NE(refusal().find("; expected one of them"), std::string::npos) << refusal();
    for (const char* const name : {"0.ply", "1.ply", "2.ply", "0.obj"}) {
      std::filesystem::remove(folder.path(frame + name));
    }
  }
}

TEST(FuzzProofsCommand, SaysWhatCannotBeSavedAndBlamesNobody) {
  const Folder folder;
  const ProcessOptions faulty = with_verified_checker(folder, takes_nothing);
  const std::string a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(0.5));
  const std::string proof = folder.path("ab.noli");
  std::string out = folder.path("out");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof}).exit_code, 0);
  // Long enough that a folder of findings fits, but no file in it.
  while (out.size() < 3900) out += "/" + std::string(100, 'x');
  out += "/" + std::string(4061 - out.size(), 'x');
  std::filesystem::create_directories(out);
  const Arguments words = {"fuzz", "proofs", proof, a, b, "--count", "20", "--verified-every", "1", "--out", out};
  const Process process = run_noli(words, faulty);
  EXPECT_EQ(process.exit_code, 4);
  EXPECT_TRUE(process.err.starts_with("noli: error: not all findings were saved: ")) << process.err;
  EXPECT_NE(process.out.find("; not saved"), std::string::npos) << process.out;
}

TEST(FuzzProofsCommand, ReplaysNoDevices) {
  if (sanitized) GTEST_SKIP() << "without a limit, what is read never ends";
  const Folder folder;
  folder.write("trajectory-0.ply", two_triangles(1));
  const std::string proof = folder.path("proof.noli");
  ProcessOptions options;
  options.address_space = std::uint64_t{1} << 30;
  const auto refuses = [&] {
    const Process process = run_noli({"fuzz", "proofs", "--replay", folder.path("")}, options);
    EXPECT_NE(process.err.find("is not a regular file"), std::string::npos) << process.err;
    return process.exit_code == 3;
  };
  std::filesystem::create_symlink("/dev/zero", proof);
  EXPECT_TRUE(refuses());
  std::filesystem::remove(proof);
  folder.write("proof.noli", "no proof");
  std::filesystem::create_symlink("/dev/zero", folder.path("trajectory-1.ply"));
  EXPECT_TRUE(refuses());
}

TEST(FuzzProofsCommand, MakesAFindingSmall) {
  namespace fs = std::filesystem;
  const Folder folder;
  const std::string a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(0.5));
  const std::string proof = folder.path("ab.noli"), finding = folder.path("finding");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof}).exit_code, 0);
  fs::create_directory(finding);
  fs::copy_file(proof, finding + "/proof.noli");
  fs::copy_file(a, finding + "/trajectory-0.ply");
  fs::copy_file(b, finding + "/trajectory-1.ply");
  const ProcessOptions faulty = with_verified_checker(folder, takes_nothing);
  const std::vector<std::string> words = {"fuzz", "proofs", "--minimise", finding, "--out", folder.path("out")};
  const Process process = run_noli(words, faulty);
  EXPECT_EQ(process.exit_code, 1) << process.err;
  EXPECT_NE(process.out.find("the plain checker: accepted, the verified one: rejected"), std::string::npos)
      << process.out;
  const std::string smaller = folder.path("out/finding-minimised");
  EXPECT_NE(process.out.find("saved as " + smaller), std::string::npos) << process.out;
  EXPECT_LE(fs::file_size(smaller + "/proof.noli"), fs::file_size(proof));
  std::ifstream readme(smaller + "/README");
  const std::string text{std::istreambuf_iterator<char>(readme), {}};
  EXPECT_NE(text.find("noli fuzz proofs --replay "), std::string::npos) << text;
  EXPECT_EQ(run_noli({"fuzz", "proofs", "--replay", smaller}, faulty).exit_code, 1) << "it still shows it";
  EXPECT_EQ(run_noli({"fuzz", "proofs", "--minimise", finding, "--out", folder.path("none")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder.path("none"))) << "nothing was wrong";
  EXPECT_EQ(run_noli({"fuzz", "proofs", "--minimise", finding, "--replay", finding}).exit_code, 3);
}

TEST(FuzzScenesCommand, JudgesASceneAgain) {
  const Folder folder;
  const std::string scene = folder.write("scene.json", ring_scene);
  EXPECT_EQ(run_noli({"fuzz", "scenes", "--replay", scene}).verdict_line(),
            "NO FINDING  end exit 0 done, verified true, resumed true");
  const Process wrong = run_noli({"fuzz", "scenes", "--replay", scene, "--wrong-place", "/bodies/0/mesh"});
  EXPECT_EQ(wrong.exit_code, 1) << "said to be wrong, and yet it runs";
  EXPECT_NE(wrong.out.find("accepted: /bodies/0/mesh"), std::string::npos) << wrong.out;
}

/// Its checker accepts nothing.
TEST(FuzzScenesCommand, MakesAFindingSmallBesideTheScene) {
  const Folder folder;
  const std::string scene = folder.write("scene.json", ring_scene), smaller = folder.path("scene-minimised.json");
  std::filesystem::copy_file(NOLI_COMMAND, folder.path("noli"));
  std::filesystem::permissions(folder.write("noli_check", takes_nothing), std::filesystem::perms::owner_all);
  ProcessOptions faulty;
  faulty.program = folder.path("noli");
  const Process process = run_noli({"fuzz", "scenes", "--minimise", scene, "--out", folder.path("")}, faulty);
  EXPECT_EQ(process.exit_code, 1) << process.out << process.err;
  EXPECT_NE(process.out.find("saved as " + smaller), std::string::npos) << process.out;
  EXPECT_LT(Json::parse(read_text(smaller)).dump().size(), Json::parse(ring_scene).dump().size());
  EXPECT_EQ(read_text(scene), ring_scene);
  EXPECT_EQ(run_noli({"fuzz", "scenes", "--replay", smaller}, faulty).exit_code, 1) << "it still shows it";
  EXPECT_EQ(run_noli({"fuzz", "scenes", "--minimise", scene, "--out", folder.path("none")}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path("none"))) << "nothing was wrong";
}

TEST(FuzzScenesCommand, TakesAWrongPlaceOfASceneToReplayOnly) {
  const Folder folder;
  const std::string scene = folder.write("scene.json", ring_scene);
  const Process process =
      run_noli({"fuzz", "scenes", "--minimise", scene, "--wrong-place", "/bodies/0/mesh", "--out", folder.path("")});
  EXPECT_EQ(process.exit_code, 3) << process.out;
  EXPECT_NE(process.err.find("--wrong-place: a scene that is wrong somewhere is not minimised"), std::string::npos);
  EXPECT_EQ(run_noli({"fuzz", "scenes", "--count", "1", "--wrong-place", "/bodies"}).exit_code, 3);
  EXPECT_EQ(run_noli({"fuzz", "scenes", "--replay", scene, "--wrong-place", "bodies"}).exit_code, 3);
}

TEST(FuzzTrajectoriesCommand, RefusesAFamilyThatItDoesNotKnow) {
  EXPECT_EQ(run_noli({"fuzz", "trajectories", "--count", "1", "--family", "landings"}).exit_code, 3);
}

/// Each scene once ended in a hang, with exit code 4, or differently when resumed. Lengths too large or too small for
/// contact are refused now.
TEST(FuzzScenesCommand, FindsNothingAnyMoreInScenesThatItFound) {
  const std::filesystem::path found = std::filesystem::path(NOLI_SOURCE_DIR) / "tests/audit/scenes/found";
  std::size_t count = 0;
  for (const auto& scene : std::filesystem::directory_iterator(found)) {
    const Process process = run_noli({"fuzz", "scenes", "--replay", scene.path().string()});
    EXPECT_EQ(process.exit_code, 0) << scene.path() << process.out << process.err;
    const bool refused = process.verdict_line().find("refused /contact/thickness") != std::string::npos;
    EXPECT_EQ(refused, scene.path().filename().string().starts_with("lengths")) << process.verdict_line();
    ++count;
  }
  EXPECT_EQ(count, 4u);
}

void expect_example(const std::string& page, std::size_t size,
                    const std::vector<std::pair<std::string, std::string>>& places) {
  const auto lines = worked_example(page, "## A worked example");
  ASSERT_EQ(lines.size(), size);
  expect_worked_example(lines, places);
}

TEST(FuzzPrograms, TheWorkedExamplesAreTrue) {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> here = {{"build/release/app/noli", NOLI_COMMAND},
                                                                 {"build/findings", folder.path("findings")},
                                                                 {"build/fall.noli", folder.path("fall.noli")}};
  expect_example("docs/audit/fuzz-trajectories.md", 3, here);
  expect_example("docs/audit/fuzz-proofs.md", 2, here);
  expect_example("docs/audit/fuzz-scenes.md", 3, here);
}

}  // namespace
}  // namespace noli::app_tests
