// SPDX-License-Identifier: Apache-2.0
//
// Tests claims and steps, right and wrong in each field, their files, and damaged files.
#include <sys/resource.h>

#include <random>
#include <thread>

#include "support.h"

namespace noli::checker::test {
namespace {

using namespace token;

Proof with_claim(const std::function<void(ClaimFields&)>& change) {
  Proof proof = two_edges();
  change(proof.claim);
  return proof;
}
Proof with_step(const std::function<void(StepFields&)>& change) {
  Proof proof = two_edges();
  proof.keep = true;
  change(proof.step);
  return proof;
}
/// Two steps: the edge moves, then rests.
Proof two_steps() {
  Proof proof = two_edges();
  proof.frames.push_back(proof.frames[1]);
  proof.tokens.push_back(proof.tokens[0]);
  return proof;
}

TEST(Claims, EachField) {
  EXPECT_ACCEPTED(two_edges().check());
  EXPECT_REJECTED(with_claim([](auto& c) { c.source = 3; }).check(), "source");
  EXPECT_REJECTED(with_claim([](auto& c) { c.dimension = 1; }).check(), "expected dimension 2 or 3");
  EXPECT_REJECTED(with_claim([](auto& c) { c.dimension = 4; }).check(), "expected dimension 2 or 3");
  EXPECT_REJECTED(with_claim([](auto& c) { c.flags = 4; }).check(), "flag");
  EXPECT_REJECTED(with_claim([](auto& c) { c.zero = 1; }).check(), "expected 0");
  EXPECT_REJECTED(with_claim([](auto& c) { c.ring = 0; }).check(), "ring");
  EXPECT_REJECTED(with_claim([](auto& c) { c.ring = 0, c.eta = 1; }).check(), "ring");
  EXPECT_REJECTED(with_claim([](auto& c) { c.ring = 2; }).check(), "ring");
  EXPECT_REJECTED(with_claim([](auto& c) { c.eta = -1; }).check(), "negative");
  EXPECT_REJECTED(with_claim([](auto& c) { c.eta = -0.0; }).check(), "negative");
  EXPECT_REJECTED(with_claim([](auto& c) { c.eta = NAN; }).check(), "finite");
  EXPECT_REJECTED(with_claim([](auto& c) { c.eta = INFINITY; }).check(), "finite");
  EXPECT_ACCEPTED(with_claim([](auto& c) { c.eta = 1, c.ring = 2; }).check());
  EXPECT_REJECTED(with_claim([](auto& c) { c.hash = std::string(32, 'h'); }).check(), "other cells");
  EXPECT_REJECTED(with_claim([](auto& c) { c.hash = std::string(33, 'h'); }).check(), "byte");
  EXPECT_REJECTED(with_claim([](auto& c) { c.excluded = {{1, 0}}; }).check(), "not in order");
  EXPECT_REJECTED(with_claim([](auto& c) { c.excluded = {{0, 1}, {0, 1}}; }).check(), "not in order");
  EXPECT_REJECTED(with_claim([](auto& c) { c.excluded = {{0, 1}, {0, 0}}; }).check(), "not in order");
  EXPECT_ACCEPTED(with_claim([](auto& c) { c.excluded = {{0, 1}, {0, 2}, {1, 1}}; }).check());
  auto groups = two_edges().groups();
  groups[0][0].second += '\0';
  EXPECT_REJECTED(two_edges().check(block_file("PROF", groups)), "expected the end");
  groups = two_edges().groups();
  groups[0][0].second.resize(50);
  EXPECT_REJECTED(two_edges().check(block_file("PROF", groups)), "expected more bytes");
  groups = two_edges().groups();
  groups[0].push_back(groups[0][0]);
  EXPECT_REJECTED(two_edges().check(block_file("PROF", groups)), "expected a block LABL");
  groups[0][0].first = "MALC";
  EXPECT_REJECTED(two_edges().check(block_file("PROF", groups)), "expected a block CLAM");
}

TEST(Claims, LabelsOfFrames) {
  Proof proof = two_edges();
  proof.labels = {3, 5};
  proof.claim.excluded = {{3, 5}};
  EXPECT_ACCEPTED(proof.with(token::N + token::F + token::X + token::F));
  EXPECT_ACCEPTED(proof.check());
  proof.claim.excluded = {{3, 3}, {5, 5}};
  EXPECT_REJECTED(proof.with(token::N + token::F + token::X + token::F), "not an excluded pair");
  auto groups = proof.groups();
  groups[0].push_back(groups[0][1]);
  EXPECT_REJECTED(proof.check(block_file("PROF", groups)), "expected a commit");
  groups = proof.groups();
  groups[0][1].second[0] = 4;
  EXPECT_REJECTED(proof.check(block_file("PROF", groups)), "other cells");
  groups = proof.groups();
  groups[0][1].second += '\0';
  EXPECT_REJECTED(proof.check(block_file("PROF", groups)), "expected the end");
  proof.labels = {3};
  EXPECT_REJECTED(proof.check(), "expected more bytes");
  proof.labels = {0, 0};
  EXPECT_REJECTED(proof.check(), "all labels are 0");
}

TEST(Claims, NoSteps) {
  auto groups = two_edges().groups();
  groups.resize(1);
  EXPECT_REJECTED(two_edges().check(block_file("PROF", groups)), "no steps");
}

TEST(Claims, NoCells) {
  Proof proof = two_edges();
  proof.cells.clear();
  proof.tree = uint(0);
  EXPECT_REJECTED(proof.check(), "no cells");
}

TEST(Claims, MergedVertices) {
  Proof proof = two_edges();
  for (auto& frame : proof.frames) frame.push_back(frame[0]), frame.push_back(frame[0]);
  proof.cells = {{0, 1}, {2, 3}, {1, 4}, {4, 5}};
  proof.cells_after = {{0, 1}, {2, 3}, {0, 0}};
  proof.claim.merged = {{4, 0}, {5, 0}};
  proof.tokens = {N + F + R + mx + D(0) + py + none + N + F + px + F};
  EXPECT_ACCEPTED(proof.check());
  proof.claim.merged = {{4, 0}, {4, 0}};
  EXPECT_REJECTED(proof.check(), "do not ascend");
  proof.claim.merged = {{4, 0}, {6, 0}};
  EXPECT_REJECTED(proof.check(), "not there");
  proof.claim.merged = {{4, 0}, {5, 4}};
  EXPECT_REJECTED(proof.check(), "later or a merged");
  proof.claim.merged = {{4, 4}};
  EXPECT_REJECTED(proof.check(), "later or a merged");
  proof.claim.merged = {{0, 4}};
  EXPECT_REJECTED(proof.check(), "later or a merged");
  proof.claim.merged = {{4, 0}, {5, 0}};
  proof.frames[0][5][2] = 1;
  EXPECT_REJECTED(proof.check(), "not where the one is");
  std::swap(proof.frames[0], proof.frames[1]);
  EXPECT_REJECTED(proof.check(), "not where the one is");
}

TEST(Claims, PointsAndDimension) {
  Proof proof = two_edges();
  for (auto& frame : proof.frames) frame.push_back({-5, 0, 0});
  EXPECT_ACCEPTED(proof.check());
  proof.cells_after = {{0, 1}, {2, 3}, {4}};
  proof.claim.flags = 2;
  EXPECT_ACCEPTED(proof.with(N + F + R + mx + px + N + F + px + F));
  proof = two_edges();
  proof.claim.dimension = 2;
  EXPECT_ACCEPTED(proof.check());
  EXPECT_REJECTED(proof.with(N + F + S(-1, 0, 1) + F + pz), "nothing is left");
  proof.frames[0][0][2] = proof.frames[1][0][2] = 100;
  EXPECT_REJECTED(proof.with(N + F + pz), "does not separate");  // there is no z
}

TEST(Claims, FramesAtRest) {
  Proof proof = two_edges();
  proof.claim.source = 1;
  proof.tokens.push_back(proof.tokens[0]);
  EXPECT_ACCEPTED(proof.check());
  proof.tokens.pop_back();
  EXPECT_REJECTED(proof.check(), "goes on");
  proof.frames.pop_back();
  EXPECT_ACCEPTED(proof.check());
  proof.claim.source = 0;
  EXPECT_REJECTED(proof.check(), "more frames");
}

TEST(Steps, EachField) {
  EXPECT_ACCEPTED(with_step([](auto&) {}).check());
  EXPECT_ACCEPTED(with_step([](auto& s) { s.p = -1200, s.q = -1200; }).check());
  EXPECT_REJECTED(with_step([](auto& s) { s.number = 1; }).check(), "wrong number");
  EXPECT_REJECTED(with_step([](auto& s) { s.t0 = 1; }).check(), "another time");
  EXPECT_REJECTED(with_step([](auto& s) { s.t1 = 2; }).check(), "another time");
  EXPECT_REJECTED(with_step([](auto& s) { s.t1 = NAN; }).check(), "finite");
  EXPECT_REJECTED(with_step([](auto& s) { s.p = -1201; }).check(), "impossible unit");
  EXPECT_REJECTED(with_step([](auto& s) { s.p = 1201; }).check(), "impossible unit");
  EXPECT_REJECTED(with_step([](auto& s) { s.q = -1201; }).check(), "impossible unit");
  EXPECT_REJECTED(with_step([](auto& s) { s.q = 1201; }).check(), "impossible unit");
  EXPECT_REJECTED(with_step([](auto& s) { s.p = 1; }).check(), "is no multiple");
  EXPECT_REJECTED(with_step([](auto& s) { s.q = 1; }).check(), "is no multiple");
  EXPECT_REJECTED(with_step([](auto& s) { s.kind = 2; }).check(), "a proof or a witness");
  EXPECT_REJECTED(with_step([](auto& s) { s.kind = 1; }).check(), "expected a block WITN");
  EXPECT_REJECTED(with_step([](auto& s) { s.hash = std::string(32, 'h'); }).check(), "another motion");
  EXPECT_REJECTED(with_step([](auto& s) { s.hash = std::string(31, 'h'); }).check(), "expected more bytes");
  EXPECT_REJECTED(with_step([](auto& s) { s.hash = std::string(33, 'h'); }).check(), "expected the end");
  EXPECT_REJECTED(with_claim([](auto& c) { c.eta = 0.5; }).check(), "is no multiple");
}

TEST(Steps, InOrderAndAll) {
  EXPECT_ACCEPTED(two_steps().check());
  auto groups = two_steps().groups();
  groups.pop_back();
  EXPECT_REJECTED(two_steps().check(block_file("PROF", groups)), "goes on");
  groups = two_steps().groups();
  groups.erase(groups.begin() + 1);
  EXPECT_REJECTED(two_steps().check(block_file("PROF", groups)), "wrong number");
  groups = two_steps().groups();
  groups.push_back(groups.back());
  EXPECT_REJECTED(two_steps().check(block_file("PROF", groups)), "wrong number");
  groups.back()[0].second[0] = 2;
  EXPECT_REJECTED(two_steps().check(block_file("PROF", groups)), "no such step");
  groups = two_steps().groups();
  groups[1].erase(groups[1].begin() + 1);
  EXPECT_REJECTED(two_steps().check(block_file("PROF", groups)), "no tree");
  groups = two_steps().groups();
  groups[2].insert(groups[2].begin() + 1, {"TREE", uint(0) + uint(2) + uint(1)});
  groups[2].back().second = N + F + px + F;
  EXPECT_ACCEPTED(two_steps().check(block_file("PROF", groups)));
  groups.insert(groups.begin() + 1, Blocks{});
  EXPECT_REJECTED(two_steps().check(block_file("PROF", groups)), "expected a block STEP");
}

TEST(Steps, OfOtherFrames) {
  Proof proof = two_steps();
  const std::string file = block_file("PROF", proof.groups());
  std::swap(proof.frames[0], proof.frames[1]);
  EXPECT_REJECTED(proof.check(file), "another motion");
  std::swap(proof.frames[0], proof.frames[1]);
  proof.frames[2][0][0] = -1;
  EXPECT_REJECTED(proof.check(file), "another motion");
  proof = two_steps();
  proof.frames.push_back(proof.frames[0]);
  EXPECT_REJECTED(proof.check(file), "goes on");
  proof.frames.resize(2);
  EXPECT_REJECTED(proof.check(file), "no such step");
  proof.cells = {{0, 1}, {3, 2}};
  EXPECT_REJECTED(proof.check(file), "other cells");
  proof = two_steps();
  proof.frames[0][0][0] = -0.0;
  EXPECT_ACCEPTED(proof.check(file));
}

TEST(Files, AreProofsOfThisVersion) {
  const std::string file = block_file("PROF", two_edges().groups());
  const auto changed = [&](std::size_t at, char c) {
    std::string other = file;
    other[at] = c;
    return two_edges().check(other);
  };
  EXPECT_REJECTED(changed(0, 'x'), "version 1");
  EXPECT_REJECTED(changed(8, 2), "version 1");
  EXPECT_REJECTED(changed(11, 1), "version 1");
  EXPECT_REJECTED(changed(12, 'T'), "another content");
  EXPECT_REJECTED(changed(29, 1), "checksum");
  EXPECT_REJECTED(changed(file.size() - 1, 1), "checksum");
  EXPECT_REJECTED(two_edges().check(file + '\0'), "open group");
  EXPECT_REJECTED(two_edges().check(file + block("STEP", "")), "expected more bytes");
  for (const std::size_t cut : {1, 4, 12, 16, 87})
    EXPECT_REJECTED(two_edges().check(file.substr(0, file.size() - cut)), "open group");
  EXPECT_REJECTED(two_edges().check(""), "version 1");
  EXPECT_REJECTED(two_edges().check(file.substr(0, 16)), "open group");
  EXPECT_REJECTED(verdict("/nowhere/at/all", {}), "cannot be opened");
  EXPECT_REJECTED(verdict("/tmp", {}), "cannot be read");
}

TEST(Files, CommitsAreCompared) {
  const std::string file = block_file("PROF", two_edges().groups());
  const std::size_t commit = file.find("CMIT");
  const auto changed = [&](std::size_t at) {
    std::string payload = file.substr(commit + 12, 72);
    payload[at] ^= 1;
    return two_edges().check(file.substr(0, commit) + block("CMIT", payload) + file.substr(commit + 88));
  };
  EXPECT_REJECTED(changed(0), "wrong number");
  EXPECT_REJECTED(changed(8), "hash of the group");
  EXPECT_REJECTED(changed(40), "running hash");
  EXPECT_REJECTED(two_edges().check(file.substr(0, commit) + block("CMIT", "")), "72 bytes");
  EXPECT_REJECTED(two_edges().check(file.substr(0, commit) + block("CMIT", file.substr(commit + 12, 72) + "x")),
                  "72 bytes");
}

TEST(Files, CutOffAnywhereSayNothing) {
  const std::string file = block_file("PROF", two_edges().groups());
  for (std::size_t n = 0; n < file.size(); ++n) EXPECT_EQ(two_edges().check(file.substr(0, n)).code, 3) << n;
}

/// Flips each bit of each payload and repairs checksums and hashes. Only another proof of the same claim, or of a claim
/// that is printed, may be accepted.
TEST(Files, BitsThatMatter) {
  const Proof proof = two_edges();
  const auto groups = proof.groups();
  const Folder folder;
  const std::vector<std::string> paths = {folder.write("0.obj", obj(proof.frames[0], proof.cells)),
                                          folder.write("1.obj", obj(proof.frames[1], proof.cells))};
  std::set<std::string> free;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (std::size_t b = 0; b < groups[g].size(); ++b) {
      for (std::size_t bit = 0; bit < 8 * groups[g][b].second.size(); ++bit) {
        auto other = groups;
        other[g][b].second[bit / 8] ^= static_cast<char>(1 << bit % 8);
        const Verdict found = verdict(folder.write("proof", block_file("PROF", other)), paths);
        EXPECT_NE(found.code, 1);
        if (found.code == 0) free.insert(groups[g][b].first + " " + std::to_string(bit / 8));
      }
    }
  }
  // The flag `points`, because every vertex has a cell, and the sign of T0, which is 0.
  EXPECT_EQ(free, (std::set<std::string>{"CLAM 2", "STEP 15"}));
}

TEST(Files, LengthsAreNotBelieved) {
  std::string file = block_file("PROF", two_edges().groups());
  for (const std::uint64_t length :
       {std::uint64_t{1} << 20, std::uint64_t{1} << 33, std::uint64_t{1} << 60, ~std::uint64_t{0}}) {
    file.replace(20, 8, raw(length));
    EXPECT_REJECTED(two_edges().check(file), "open group");
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20);  // KiB
}

TEST(Files, ThroughAPipe) {
  const Proof proof = two_edges();
  const Folder folder;
  const std::vector<std::string> paths = {folder.write("0.obj", obj(proof.frames[0], proof.cells)),
                                          folder.write("1.obj", obj(proof.frames[1], proof.cells))};
  const std::string file = block_file("PROF", proof.groups());
  for (const std::size_t size : {file.size(), file.size() - 1, std::size_t{40}}) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    std::thread writer([&] {
      for (std::size_t i = 0; i < size; i += 7)
        EXPECT_GT(write(ends[1], file.data() + i, std::min<std::size_t>(7, size - i)), 0);
      close(ends[1]);
    });
    const Verdict found = verdict("/dev/fd/" + std::to_string(ends[0]), paths, Fields{});  // the pipe is read once
    writer.join();
    close(ends[0]);
    EXPECT_EQ(found.code, size == file.size() ? 0 : 3) << found.words;
  }
}

}  // namespace
}  // namespace noli::checker::test
