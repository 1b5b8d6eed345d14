// SPDX-License-Identifier: Apache-2.0
//
// Tests proofs of frames from end to end: `noli verify --proof` writes them, `noli check` checks them.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "tests/app/process.h"
#include "tests/app/runs/killer.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"
#include "tests/app/sequences.h"

namespace noli::app_tests {
namespace {

class Proof : public testing::Test {
 protected:
  std::vector<std::string> write(const Sequence& sequence) const {
    return write_frames(sequence,
                        [this](const std::string& name, const std::string& text) { return folder.write(name, text); });
  }
  std::vector<std::string> triangles(const std::vector<double>& heights) const {
    std::vector<std::string> paths;
    for (const double height : heights)
      paths.push_back(folder.write(std::to_string(paths.size()) + ".ply", two_triangles(height)));
    return paths;
  }
  static Process verify(const std::vector<std::string>& frames, std::vector<std::string> more) {
    more.insert(more.begin(), "verify");
    more.insert(more.end(), frames.begin(), frames.end());
    return run_noli(more);
  }
  Process prove(const std::vector<std::string>& frames, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> options = {"--force", "--proof", proof(), "--claim-out", claim()};
    options.insert(options.end(), more.begin(), more.end());
    return verify(frames, options);
  }
  /// Runs `noli check` with the claim of `noli verify`.
  Process check_by(std::vector<std::string> arguments, const std::vector<std::string>& frames) const {
    if (fs::exists(claim())) arguments.insert(arguments.end(), {"--claim", claim()});
    arguments.insert(arguments.begin(), {"check", proof()});
    arguments.insert(arguments.end(), frames.begin(), frames.end());
    return run_noli(arguments);
  }
  /// Runs all checkers that are built, and expects the same answer.
  Process check(const std::vector<std::string>& frames, std::vector<std::string> more = {}) const {
    const Process plain = check_by(more, frames);
    if (!verified_checker_is_there()) return plain;
    more.emplace_back("--verified");
    const Process verified = check_by(more, frames);
    EXPECT_EQ(verified.exit_code, plain.exit_code) << plain.out << verified.out;
    if (plain.exit_code != 3) {
      EXPECT_EQ(verified.verdict_of_checker(), plain.verdict_of_checker());
    }
    return plain;
  }
  std::string proof() const { return folder.path("proof.noli"); }
  std::string claim() const { return folder.path("claim.json"); }

  Folder folder;
};

TEST_F(Proof, SequencesWithoutContactAreProved) {
  const auto sequences = untouched_sequences();
  EXPECT_GE(sequences.size(), 30U);
  for (const Sequence& sequence : sequences) {
    const Folder own;
    const auto frames =
        write_frames(sequence, [&](const std::string& name, const std::string& text) { return own.write(name, text); });
    const Process process = prove(frames, sequence.options);
    EXPECT_EQ(process.exit_code, 0) << sequence.name << ": " << process.out.substr(0, 300) << process.err;
    EXPECT_EQ(process.verdict_line().substr(0, 8), "PROVED  ") << sequence.name;
    const Process checked = check(frames);
    EXPECT_EQ(checked.exit_code, 0) << sequence.name << ": " << checked.out;
    EXPECT_EQ(checked.verdict_line().substr(0, 8), "ACCEPTED") << sequence.name;
  }
}

TEST_F(Proof, AContactHasAWitness) {
  const auto frames = triangles({1, 0.5, -2});
  const Process process = prove(frames);
  EXPECT_EQ(process.exit_code, 1) << process.err;
  EXPECT_NE(process.out.find("The checker says of"), std::string::npos) << process.out;
  const Process checked = check(frames);
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_EQ(checked.verdict_line().substr(0, 7), "REFUTED");
  EXPECT_NE(checked.out.find("REFUTED  in step 2, vertices {3} of cell 1 and {0 1 2} of cell 0 meet"),
            std::string::npos)
      << checked.out;
}

TEST_F(Proof, CellsThatIntersectFromTheBeginningHaveAWitness) {
  const auto deck = folder.write("deck.ply", sail_through_deck());
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--static"}}) {
    const std::vector<std::string> frames =
        more.empty() ? std::vector<std::string>{deck, deck} : std::vector<std::string>{deck};
    EXPECT_EQ(prove(frames, more).exit_code, 1);
    const Process checked = check(frames);
    EXPECT_EQ(checked.exit_code, 1) << checked.out;
  }
}

TEST_F(Proof, IsOfItsFramesInTheirOrderAlone) {
  const auto frames = triangles({1, 0.5, 0.25});
  ASSERT_EQ(prove(frames).exit_code, 0);
  fs::remove(claim());  // it requires two steps, and then a third is not read
  EXPECT_EQ(check(frames).exit_code, 0);
  const std::vector<std::vector<std::string>> others = {
      {frames[1], frames[0], frames[2]},
      {frames[0], frames[1]},
      {frames[0], frames[1], frames[2], frames[2]},
      {frames[2], frames[1], frames[0]},
      {frames[0], frames[1], folder.write("other.ply", two_triangles(0.3))}};
  for (const auto& other : others) {
    const Process checked = check(other, {"--order", "given"});
    EXPECT_EQ(checked.exit_code, 3) << checked.out;
    EXPECT_EQ(checked.verdict_line().substr(0, 8), "REJECTED");
  }
}

TEST_F(Proof, TheSameMotionFromAnotherFormatHasTheSameProof) {
  const auto ply = triangles({1, 0.5});
  std::vector<std::string> obj;
  for (const std::string height : {"1", "5e-1"}) {
    const std::string text = "v 0 0 0\nv 4 0 -0\nv 0 4 0\nv 1 1 " + height + "\nv 1.5 1 " + height + "\nv 1 1.5 " +
                             height + "\nf 1 2 3\nf 4 5 6\n";
    obj.push_back(folder.write(std::to_string(obj.size()) + ".obj", text));
  }
  ASSERT_EQ(prove(ply).exit_code, 0);
  EXPECT_EQ(check(obj).exit_code, 0);
  const std::string bytes = bytes_of(proof());
  ASSERT_EQ(prove(obj).exit_code, 0);
  EXPECT_EQ(bytes_of(proof()) == bytes, true);
}

TEST_F(Proof, SameBytesForAnyNumberOfThreads) {
  const auto frames = write(large_sequence(4000));
  std::string first;
  for (const char* threads : {"1", "2", "5"}) {
    ASSERT_EQ(prove(frames, {"--threads", threads, "--no-check"}).exit_code, 0);
    const std::string bytes = bytes_of(proof());
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes == first, true) << threads;
  }
}

TEST_F(Proof, WithoutTheCheckTheVerdictIsNoContact) {
  const auto frames = triangles({1, 0.5});
  EXPECT_EQ(prove(frames, {"--no-check"}).verdict_line().substr(0, 12), "NO CONTACT  ");
  EXPECT_EQ(prove(frames).verdict_line().substr(0, 8), "PROVED  ");
}

TEST_F(Proof, KeepsADistance) {
  const auto frames = triangles({1, 0.5});
  EXPECT_EQ(prove(frames, {"--min-distance", "0.4999"}).verdict_line().substr(0, 8), "PROVED  ");
  EXPECT_EQ(check(frames).exit_code, 0);
  for (const char* distance : {"0.5", "0.5001", "0.75"}) {
    const Process process = prove(frames, {"--min-distance", distance});
    EXPECT_EQ(process.exit_code, 1) << distance;
    EXPECT_EQ(process.verdict_line().substr(0, 10), "TOO NEAR  ") << process.verdict_line();
    EXPECT_EQ(check(frames).exit_code, 1) << distance;
  }
  EXPECT_EQ(verify(frames, {"--min-distance", "0.1"}).verdict_line().substr(0, 8), "PROVED  ");
  EXPECT_EQ(verify(frames, {"--min-distance", "0.1", "--no-check"}).verdict_line().substr(0, 12), "NO CONTACT  ");
  EXPECT_EQ(verify(frames, {"--min-distance", "0.5", "--no-check"}).exit_code, 1);
  EXPECT_EQ(verify(frames, {"--min-distance", "0.5"}).verdict_line().substr(0, 10), "TOO NEAR  ");
  EXPECT_EQ(prove(frames, {"--min-distance", "-1"}).exit_code, 3);
  EXPECT_EQ(prove(frames, {"--min-distance-from-ring", "2"}).exit_code, 3);
}

TEST_F(Proof, NeighboursMayBeNearerThanTheDistance) {
  Sequence sheet = untouched_sequences()[0];
  const auto frames = write(sheet);
  EXPECT_EQ(prove(frames, {"--min-distance", "0.9"}).exit_code, 1);
  EXPECT_EQ(check(frames).exit_code, 1);
  for (const char* ring : {"2", "3", "4"}) {
    const Process process = prove(frames, {"--min-distance", "0.9", "--min-distance-from-ring", ring});
    EXPECT_EQ(process.exit_code, 0) << process.out.substr(0, 300) << process.err;
    EXPECT_EQ(check(frames).exit_code, 0) << ring;
  }
  EXPECT_EQ(prove(frames, {"--min-distance", "2.5", "--min-distance-from-ring", "2"}).exit_code, 1);
  EXPECT_EQ(check(frames).exit_code, 1);
}

TEST_F(Proof, IsNotWrittenOverAFrame) {
  const auto frames = triangles({1, 0.5});
  const std::string before = bytes_of(frames[1]);
  const Process process = verify(frames, {"--proof", frames[1]});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_EQ(bytes_of(frames[1]), before);
  EXPECT_EQ(verify(frames, {"--proof", folder.path("no/such/folder.noli")}).exit_code, 3);
}

TEST_F(Proof, IsWrittenToAFileOfItsOwn) {
  const auto frames = triangles({1, 0.5});
  EXPECT_EQ(verify(frames, {"--proof", "/dev/null"}).exit_code, 3);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const std::string result = folder.write("result.json", "{}");
  EXPECT_EQ(verify(frames, {"--proof", result, "--json", result}).exit_code, 3);
  EXPECT_EQ(bytes_of(result), "{}");
  const std::string both = folder.path("both");
  EXPECT_EQ(verify(frames, {"--proof", both, "--json", folder.path("./both")}).exit_code, 3);
  EXPECT_FALSE(fs::exists(both));
  EXPECT_EQ(verify(frames, {"--proof", "-"}).exit_code, 3);
}

TEST_F(Proof, IsNotTouchedBeforeThereIsANewOne) {
  const auto frames = triangles({1, 0.5});
  ASSERT_EQ(prove(frames).exit_code, 0);
  const std::string before = bytes_of(proof());
  const Process process = prove(frames, {"--time-limit", "0.001ms"});
  EXPECT_EQ(process.exit_code, 2);
  EXPECT_NE(process.out.find("No proof was written to"), std::string::npos) << process.out;
  EXPECT_EQ(bytes_of(proof()), before);
}

TEST_F(Proof, AnyContactHasAWitness) {
  const auto frames = triangles({1, 0.5, -2});
  const Process process = prove(frames, {"--first-only"});
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_NE(process.out.find("The checker says of"), std::string::npos) << process.out;
  EXPECT_EQ(check(frames).exit_code, 1);
}

TEST_F(Proof, GoesToTheCheckerAtOnceIfNobodyWantsAFile) {
  const auto frames = triangles({1, 0.5, 0.25});
  const Process process = verify(frames, {"--json", folder.path("result.json")});
  EXPECT_EQ(process.verdict_line().substr(0, 8), "PROVED  ");
  const Json proof = Json::parse(read_text(folder.path("result.json")))["proof"];
  EXPECT_EQ(
      proof,
      (Json{{"file", nullptr}, {"witnesses", 0}, {"checked", "accepted: nothing touches"}, {"not_checked", nullptr}}));
  const Process touching = verify(triangles({1, 0.5, -2}), {"-v"});
  EXPECT_EQ(touching.exit_code, 1);
  EXPECT_NE(touching.out.find("The checker says of the proof: refuted: in step 2, vertices {3} of cell 1"),
            std::string::npos)
      << touching.out;
  EXPECT_EQ(verify(triangles({1, 0.5, -2}), {"--no-check"}).out.find("The checker says"), std::string::npos);
}

/// The checker reads the proof of the first step while it is found, so here it has to begin again.
TEST_F(Proof, AContactFoundLateInTheFirstStepIsChecked) {
  const auto frame = [&](const std::string& name, double height) {
    std::vector<Position> points;
    std::vector<std::array<VertexId, 3>> faces;
    const auto face = [&](double x, double z) {
      const auto v = static_cast<VertexId>(points.size());
      points.insert(points.end(), {{x, 0, z}, {x + 0.5, 0, z}, {x, 0.5, z}});
      faces.push_back({v, v + 1, v + 2});
    };
    for (int i = 0; i < 9000; ++i) face(i, 0);
    face(9000, 0);
    face(9000, height);
    return folder.write(name, ply_text(points, faces));
  };
  const std::string a = frame("a.ply", 1), b = frame("b.ply", -1), c = frame("c.ply", -2);
  const Process process = verify({a, b, c}, {"-v", "--keep-going"});
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_NE(process.out.find("The checker says of the proof: refuted: in step 1, "), std::string::npos) << process.out;
  const std::string file = folder.path("result.json");
  for (const char* const threads : {"1", "2"}) {
    EXPECT_EQ(verify({a, b}, {"--threads", threads, "--json", file, "--force"}).exit_code, 1);
    const Json result = Json::parse(read_text(file));
    EXPECT_EQ(result["proof"]["witnesses"], 1);
    EXPECT_EQ(verify({b, c}, {"--threads", threads}).verdict_line().substr(0, 8), "PROVED  ");
  }
}

TEST_F(Proof, GoesToTheCheckerForEachKindOfQuestion) {
  const std::vector<std::string> questions = {"--strict",     "--points",   "--static",    "--first-only",
                                              "--keep-going", "--only-new", "--threads=1", "--dimension=3"};
  const auto apart = triangles({1, 0.5, 0.25});
  for (const std::string& question : questions) {
    EXPECT_EQ(verify(apart, {question}).verdict_line().substr(0, 8), "PROVED  ") << question;
  }
  const auto touching = triangles({1, -2, 0.5});
  for (const std::string& question : questions) {
    if (question == "--static") continue;  // each frame by itself is free of contact
    const Process contact = verify(touching, {question, "-v"});
    EXPECT_EQ(contact.exit_code, 1) << question;
    EXPECT_NE(contact.out.find("refuted: in step 1, "), std::string::npos) << question << contact.out;
  }
}

TEST_F(Proof, ABuildWithoutTheVerifiedCheckerSaysSo) {
  const auto frames = triangles({1, 0.5});
  const std::string proof = folder.path("p.noli");
  ASSERT_EQ(run_noli({"verify", frames[0], frames[1], "--proof", proof}).exit_code, 0);
  const fs::path programs = fs::path(NOLI_COMMAND).parent_path();
  for (const char* program : {"noli", "noli_check"}) fs::copy_file(programs / program, folder.path(program));
  const auto check_with = [&](const std::string& option) {
    const std::string command = folder.path("noli") + " check " + proof + " " + frames[0] + " " + frames[1] + option +
                                " >" + folder.path("out") + " 2>" + folder.path("err");
    return WEXITSTATUS(std::system(command.c_str()));
  };
  EXPECT_EQ(check_with(""), 0);
  EXPECT_EQ(read_text(folder.path("out")).find("--verified"), std::string::npos);
  EXPECT_EQ(check_with(" --verified"), 3);
  EXPECT_NE(read_text(folder.path("err")).find("built without the verified checker; install"), std::string::npos);
}

TEST_F(Proof, ACheckerIsNotTrustedBlindly) {
  const auto frames = triangles({1, 0.5});
  fs::copy_file(NOLI_COMMAND, folder.path("noli"));
  const auto verify_with = [&](const std::string& script) {
    const std::string checker = folder.write("noli_check", "#!/bin/sh\n" + script + "\n");
    fs::permissions(checker, fs::perms::owner_all);
    const std::string command = folder.path("noli") + " verify " + frames[0] + " " + frames[1] + " >" +
                                folder.path("out") + " 2>" + folder.path("err");
    const int status = std::system(command.c_str());
    return std::pair(WEXITSTATUS(status), read_text(folder.path("err")));
  };
  const std::string real = fs::path(NOLI_COMMAND).parent_path() / "noli_check";
  EXPECT_EQ(verify_with("exec " + real + " \"$@\"").first, 0);
  // Checkers that answer about another claim, or about none.
  for (const char* const change :
       {"s/motion=linear/motion=rest/", "s/dimension=3/dimension=2/", "s/steps=1/steps=2/", "s/strict=0/strict=1/",
        "s/points=0/points=1/", "s/distance=0/distance=1/", "s/ring=1/ring=2/", "s/merged=0/merged=1/",
        "s/excluded=/excluded=0-0/", "s/cells=./cells=x/", "s/empty=0/empty=1/", "s/to=1/to=2/", "s/from=0/from=1/",
        "s/ to=.*//", "s/^claim.*/claim/", "/^claim/d"}) {
    const auto [code, error] = verify_with(real + " \"$@\" | sed '" + change + "'");
    EXPECT_EQ(code, 4) << change;
    EXPECT_NE(error.find("claim"), std::string::npos) << change << error;
  }
  for (const char* script : {"cat >/dev/null; echo accepted: as I was told", "exit 0", "cat >/dev/null",
                             "cat >/dev/null; echo accepted: no; exit 3", "cat >/dev/null; echo refuted: so; exit 1",
                             "exit 7", "kill -9 $$"}) {
    const auto [code, error] = verify_with(script);
    EXPECT_EQ(code, 4) << script;
    EXPECT_NE(error.find("check"), std::string::npos) << script << error;
  }
  fs::remove(folder.path("noli_check"));
  const std::string command = folder.path("noli") + " verify " + frames[0] + " " + frames[1] + " 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
}

TEST_F(Proof, CutOffItIsRejected) {
  const auto frames = triangles({1, 0.5, 0.25});
  ASSERT_EQ(prove(frames).exit_code, 0);
  const std::string whole = bytes_of(proof());
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    folder.write("proof.noli", whole.substr(0, size));
    EXPECT_EQ(check(frames).exit_code, 3) << size;
  }
  folder.write("proof.noli", whole + std::string(1, '\0'));
  EXPECT_EQ(check(frames).exit_code, 3);
}

TEST_F(Proof, CheckSaysWhatItNeeds) {
  EXPECT_EQ(run_noli({"check", folder.path("nothing"), folder.path("a.ply")}).exit_code, 3);
  EXPECT_EQ(run_noli({"check", folder.path("nothing")}).exit_code, 3);
  const Process process = run_noli({"check", folder.write("empty", ""), folder.write("a.ply", two_triangles(1))});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_EQ(process.verdict_line().substr(0, 8), "REJECTED");
}

TEST_F(Proof, RealFramesThatTouchHaveWitnesses) {
  for (const char* name : {"cloth-ball", "cloth-funnel", "armadillo-rollers"}) {
    const auto data = real_data(std::string("frames/") + name);
    if (!data) continue;
    std::vector<std::string> frames;
    for (const auto& entry : fs::directory_iterator(*data)) frames.push_back(entry.path());
    std::sort(frames.begin(), frames.end());
    EXPECT_EQ(prove(frames).exit_code, 1) << name;
    EXPECT_EQ(check(frames).exit_code, 1) << name;
  }
}

TEST_F(Proof, ARealRodTwistIsProved) {
  const auto data = real_data("frames/rod-twist-clean");
  if (!data) return;
  const std::vector<std::string> frames = {(*data / "0.ply").string(), (*data / "1.ply").string()};
  EXPECT_EQ(prove(frames).verdict_line().substr(0, 8), "PROVED  ");
}

TEST_F(Proof, AFullDiskIsNoVerdict) {
  const auto frames = write(large_sequence(4000));
  ProcessOptions limit;
  limit.file_size = 100'000;
  std::vector<std::string> arguments = {"verify", "--force", "--proof", proof()};
  arguments.insert(arguments.end(), frames.begin(), frames.end());
  const Process process = run_noli(arguments, limit);
  EXPECT_EQ(process.exit_code, 4) << process.out << process.err;
  EXPECT_EQ(process.out, "");
  EXPECT_EQ(check(frames).exit_code, 3);
}

TEST_F(Proof, SlowKilledItIsNeverAcceptedAsWhole) {
  Sequence sequence = large_sequence(6000);
  for (int f = 0; f < 4; ++f) sequence.frames.push_back(sequence.frames[f % 2]);
  const auto frames = write(sequence);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(prove(frames, {"--no-check"}).exit_code, 0);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
  const std::string bytes = bytes_of(proof());
  std::vector<std::string> arguments = {"verify", "--no-check", "--force", "--proof", proof()};
  arguments.insert(arguments.end(), frames.begin(), frames.end());
  int rejected = 0, accepted = 0;
  for (int i = 0; i < 200; ++i) {
    fs::remove(proof());
    run_and_kill(arguments, whole * i / 200);
    if (!fs::exists(proof())) continue;
    const Process checked = check_by({}, frames);
    EXPECT_EQ(checked.exit_code, bytes_of(proof()) == bytes ? 0 : 3) << checked.out;
    (checked.exit_code == 0 ? accepted : rejected) += 1;
  }
  std::printf("rejected %d, whole before the kill %d\n", rejected, accepted);
  EXPECT_GE(rejected, 20);
}

using ProofOfRun = Simulate;

TEST_F(ProofOfRun, EachWindowIsProvedAsItIsWritten) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run")}).exit_code, 0);
  const Process checked = run_noli({"check", run_path("run")});
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  EXPECT_NE(checked.out.find("25 steps"), std::string::npos) << checked.out;
  const Process verified = run_noli({"verify", run_path("run")});
  EXPECT_NE(verified.out.find("\nNext: noli check "), std::string::npos) << verified.out;
  ASSERT_EQ(run_noli({"verify", run_path("run"), "--proof", folder.path("again.noli")}).exit_code, 0);
  EXPECT_EQ(bytes_of(folder.path("again.noli")) == bytes_of(run_path("run") + "/proof.blocks"), true);
}

TEST_F(ProofOfRun, GoesOnWithTheRun) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  const std::string whole = bytes_of(run_path("whole") + "/proof.blocks");
  // The run stops at the same window; the proof ends there, lacks windows, or has no content.
  for (const std::uintmax_t size : {whole.size(), whole.size() / 2, std::size_t{100}, std::size_t{3}}) {
    ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("part"), "--until", "0.1", "--force"}).exit_code, 0);
    EXPECT_EQ(run_noli({"check", run_path("part")}).exit_code, 0);
    const fs::path proof = run_path("part") + "/proof.blocks";
    fs::resize_file(proof, std::min(size, fs::file_size(proof)));
    ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("part"), "--resume"}).exit_code, 0);
    EXPECT_EQ(bytes_of(proof) == whole, true) << size;
    EXPECT_EQ(run_noli({"check", run_path("part")}).exit_code, 0);
  }
}

TEST_F(ProofOfRun, IsOfItsRunAlone) {
  Json one = hanging_sheet(), other = hanging_sheet();
  other["gravity"] = {0, 0, -9.8};
  ASSERT_EQ(run_noli({"simulate", folder.write("one.json", one.dump()), "-o", run_path("one")}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", folder.write("other.json", other.dump()), "-o", run_path("other")}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", run_path("one") + "/proof.blocks", run_path("one")}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", run_path("one") + "/proof.blocks", run_path("other")}).exit_code, 3);
}

TEST_F(ProofOfRun, IsNotThereWithoutWorldLinesOrIfNotWanted) {
  Json frames = hanging_sheet();
  frames["record"] = "frames";
  ASSERT_EQ(run_noli({"simulate", scene(frames), "-o", run_path("frames")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(run_path("frames") + "/proof.blocks"));
  EXPECT_EQ(run_noli({"check", run_path("frames")}).exit_code, 3);
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("none"), "--no-proof"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(run_path("none") + "/proof.blocks"));
}

}  // namespace
}  // namespace noli::app_tests
