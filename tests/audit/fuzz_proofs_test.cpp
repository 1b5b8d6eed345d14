// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/fuzz_proofs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>

#include <noli/errors.h>
#include "audit/fuzz/proofs/claim_oracle.h"
#include "audit/fuzz/proofs/minimise_proof.h"
#include "certify/proofs/parsed_claim.h"
#include "proofs/prover/tokens/proof_file.h"
#include "tests/support/temporary_folder.h"

namespace noli::audit {
namespace {

using namespace std::string_literals;

class StringSink : public Sink {
 public:
  explicit StringSink(std::string& bytes) : bytes_(bytes) {}
  void write(std::string_view bytes) override { bytes_ += bytes; }
  void sync() override {}
  void truncate(std::uint64_t size) override { bytes_.resize(size); }

 private:
  std::string& bytes_;
};

/// Two loose edges; the second comes nearer to the first.
FrameMotion two_edges() {
  FrameMotion motion;
  motion.mesh = {4, {}, {{0, 1}, {2, 3}}, {}};
  motion.frames = {{{0, -1, 0}, {0, 1, 0}, {4, 0, -1}, {4, 0, 1}}, {{0, -1, 0}, {0, 1, 0}, {2, 0, -1}, {2, 0, 1}}};
  return motion;
}

/// The worked example of proofs/FORMAT.md, but with the step in two halves; the second half encodes its direction in
/// another form.
ProofCase example() {
  const FrameMotion motion = two_edges();
  const std::vector<std::uint32_t> labels(2, 0);
  ProofHeader header;
  header.vertices = 4;
  header.mesh = &motion.mesh;
  header.labels = labels;
  ProofCase made;
  made.name = "example";
  ProofFile file(std::make_unique<StringSink>(made.proof), header);
  file.begin_step(0, ProofFile::Kind::proof, WorldLines::from_frames(motion.frames[0], motion.frames[1]), 0);
  file.tree("\0\1\2"s);
  file.tokens("\x03\x04\0\x09\x10\xff\x03\0\0\x04"s);
  file.commit();
  made.groups = parse_proof(made.proof, "example");
  made.extension = "ply";
  made.files = {file_bytes(motion, 0), file_bytes(motion, 1)};
  return made;
}

using Answer = ProofAnswer (*)(const ProofFiles& files);

/// A checker implemented by a function.
class FakeChecker : public ProofChecker {
 public:
  explicit FakeChecker(Answer answer) : answer_(answer) {}
  ProofAnswer check(const ProofFiles& files) override { return answer_(files); }

 private:
  Answer answer_;
};

/// Accepts only the example.
ProofAnswer knows_one(const ProofFiles& files) {
  static const ProofCase good = example();
  return {files.proof == good.proof && files.files == good.files ? 0 : 3, ""};
}

/// Accepts every file with correct checksums.
ProofAnswer believes_all(const ProofFiles& files) {
  try {
    parse_proof(files.proof, "proof");
    return {0, ""};
  } catch (const InputError&) {
    return {3, ""};
  }
}

class FuzzProofs : public testing::Test {
 protected:
  FuzzProofs() {
    options.limits.seed = 1;
    options.limits.count = 2000;
    options.limits.threads = 1;
    options.cases = {example()};
    options.make_checkers = [this] {
      return Checkers{std::make_unique<FakeChecker>(plain),
                      verified == nullptr ? nullptr : std::make_unique<FakeChecker>(verified)};
    };
    options.out = folder / "out";
    options.max_findings = 3;
  }

  test::TemporaryFolder folder;
  Answer plain = knows_one, verified = knows_one;
  ProofFuzzOptions options;
};

TEST_F(FuzzProofs, FindsNothingWhereNothingIsWrong) {
  const ProofFuzzReport report = fuzz_proofs(options);
  EXPECT_EQ(report.findings_total, 0u) << report.findings[0].difference;
  EXPECT_EQ(report.items, 2000u);
  EXPECT_GT(report.codes.rejected, 1900u);
  EXPECT_GE(report.checked_verified, 40u);
  EXPECT_FALSE(std::filesystem::exists(options.out));
}

TEST_F(FuzzProofs, FindsAFalseClaimThatIsAccepted) {
  plain = believes_all;
  verified = nullptr;
  const ProofFuzzReport report = fuzz_proofs(options);
  ASSERT_FALSE(report.findings.empty());
  std::set<std::string> differences;
  for (const ProofFinding& finding : report.findings) differences.insert(finding.difference);
  EXPECT_TRUE(differences.contains("the plain checker: accepted, but the claim is false")) << *differences.begin();
}

TEST_F(FuzzProofs, FindsCheckersThatDiffer) {
  plain = believes_all;
  options.verified_every = 1;
  const ProofFuzzReport report = fuzz_proofs(options);
  ASSERT_FALSE(report.findings.empty());
  const ProofFinding& finding = report.findings[0];
  EXPECT_EQ(finding.difference, "the plain checker: accepted, the verified one: rejected");
  std::ifstream readme(finding.place / "README");
  const std::string text{std::istreambuf_iterator<char>(readme), {}};
  EXPECT_NE(text.find("noli fuzz proofs --replay "), std::string::npos) << text;
  const ProofFiles saved = read_proof_files(finding.place);
  EXPECT_EQ(saved.proof, finding.files.proof);
  EXPECT_EQ(saved.files, finding.files.files);
  EXPECT_EQ(judge_proof(saved, options.make_checkers()).difference, finding.difference);
  EXPECT_EQ(knows_one(finding.files).code, 3);
  EXPECT_EQ(believes_all(finding.files).code, 0) << "what was saved still shows it";
}

TEST_F(FuzzProofs, KeepsOneProofOfEachShapeAndJudgesThemFirst) {
  const auto words_of_size = [](const ProofFiles& files) -> ProofAnswer {
    return {3, "", "rejected: at " + std::to_string(files.proof.size()) + (files.proof.size() % 2 == 0 ? "" : " odd")};
  };
  plain = words_of_size;
  verified = nullptr;
  options.corpus = folder / "corpus";
  std::filesystem::create_directory(*options.corpus);
  EXPECT_EQ(fuzz_proofs(options).corpus_size, 2u) << "numbers are no shapes";
  options.limits.seed = 2;
  EXPECT_EQ(fuzz_proofs(options).corpus_size, 2u);

  plain = [](const ProofFiles&) -> ProofAnswer { return {-1, "signal 11"}; };
  const ProofFuzzReport report = fuzz_proofs(options);
  ASSERT_GE(report.findings.size(), 2u);
  EXPECT_TRUE(report.findings[0].generator.starts_with("corpus/shape-")) << report.findings[0].generator;
  EXPECT_TRUE(std::filesystem::exists(report.findings[1].place / "proof.noli"));
}

TEST_F(FuzzProofs, KeepsAMutantThatIsNoFindingThoughOneOfItsShapeIs) {
  plain = [](const ProofFiles&) -> ProofAnswer { return {3, "", "rejected: always"}; };
  verified = [](const ProofFiles& files) -> ProofAnswer { return {files.proof.size() % 2 == 0 ? 0 : 3, ""}; };
  options.verified_every = 1;
  options.corpus = folder / "corpus";
  std::filesystem::create_directory(*options.corpus);
  const ProofFuzzReport report = fuzz_proofs(options);
  ASSERT_GT(report.findings_total, 0u);
  ASSERT_LT(report.findings_total, report.items);
  ASSERT_EQ(report.corpus_size, 1u);
  const auto kept = std::filesystem::directory_iterator(*options.corpus)->path();
  EXPECT_EQ(read_proof_files(kept).proof.size() % 2, 1u) << "what was kept is what was no finding";
}

/// Simulates a full disk while the object exists.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_ = {};
};

TEST_F(FuzzProofs, SavesAFindingWholeOrNotAtAll) {
  namespace fs = std::filesystem;
  plain = believes_all;
  options.verified_every = 1;
  const auto with_full_disk = [&] {
    const SmallFiles full(100);
    return fuzz_proofs(options);
  };
  const ProofFuzzReport none = with_full_disk();
  EXPECT_THROW(none.not_saved.require_nothing(), WriteError);
  ASSERT_EQ(none.findings.size(), 3u);
  for (const ProofFinding& finding : none.findings) EXPECT_TRUE(finding.place.empty());
  EXPECT_TRUE(fs::is_empty(options.out)) << *fs::directory_iterator(options.out);

  const fs::path first = fuzz_proofs(options).findings[0].place;
  EXPECT_EQ(read_proof_files(first).proof, none.findings[0].files.proof);
  std::ofstream(first / "proof.noli") << "of the user";
  with_full_disk();
  fuzz_proofs(options);
  EXPECT_EQ(fs::file_size(first / "proof.noli"), 11u) << "what is there already stays";
  const fs::directory_iterator folders(options.out);
  EXPECT_EQ(std::distance(begin(folders), end(folders)), 6);
}

TEST_F(FuzzProofs, CountsNoAnswerAsRejected) {
  plain = [](const ProofFiles& files) -> ProofAnswer {
    return files.proof.size() % 2 == 0 ? ProofAnswer{-1, "exit code 0"} : ProofAnswer{3, ""};
  };
  verified = nullptr;
  options.limits.count = 200;
  const ProofFuzzReport report = fuzz_proofs(options);
  EXPECT_GT(report.codes.failed, 0u);
  EXPECT_EQ(report.codes.failed, report.findings_total);
  EXPECT_EQ(report.codes.failed + report.codes.rejected, 200u);
  EXPECT_EQ(report.items, 200u);
  std::uint64_t failed = 0;
  for (const auto& [name, tally] : report.mutations) failed += tally.failed;
  EXPECT_GE(failed, report.codes.failed) << "a mutant may be of several mutations";
}

TEST_F(FuzzProofs, PutsBackWhatIsNotNeeded) {
  // A fault that depends on one byte: the claim's source.
  plain = [](const ProofFiles& files) -> ProofAnswer {
    try {
      const auto claim = parse_claim(parse_proof(files.proof, "proof"));
      if (claim && claim->source == 3) return {-1, "signal 11"};
    } catch (const InputError&) {
    }
    return {3, ""};
  };
  const ProofFuzzReport report = fuzz_proofs(options);
  ASSERT_FALSE(report.findings.empty());
  const ProofCase good = example();
  const ProofGroups groups = parse_proof(report.findings[0].files.proof, "finding");
  int different = 0;
  for (std::size_t i = 0; i < good.groups[0][0].payload.size(); ++i) {
    different += good.groups[0][0].payload[i] != groups[0][0].payload[i] ? 1 : 0;
  }
  EXPECT_EQ(different, 1);
  EXPECT_EQ(report.findings[0].files.files, good.files);
}

/// The example's files, with a third frame that is not part of the proof.
ProofFiles example_files() {
  const ProofCase good = example();
  return {good.proof, good.extension, {good.files[0], good.files[1], good.files[1]}};
}

TEST(MinimiseProof, LeavesOutWhatIsNotNeeded) {
  // A fault triggered by a single token in any block.
  const auto fails = [](const ProofFiles& files) {
    if (believes_all(files).code != 0) return false;
    for (const ProofGroup& group : parse_proof(files.proof, "candidate")) {
      for (const ProofBlock& block : group) {
        if (block.payload.find('\x09') != std::string::npos) return true;
      }
    }
    return false;
  };
  ASSERT_TRUE(fails(example_files()));
  const ProofFiles smallest = minimise(example_files(), fails, 5000);
  EXPECT_EQ(smallest.files.size(), 1u);
  const ProofGroups groups = parse_proof(smallest.proof, "smallest");
  ASSERT_EQ(groups.size(), 1u);
  ASSERT_EQ(groups[0].size(), 1u);
  EXPECT_EQ(groups[0][0].payload, "\x09");
}

TEST(MinimiseProof, MakesBytesZero) {
  const auto size = [](const ProofFiles& files) { return files.proof.size(); };
  const ProofFiles all = example_files();
  const ProofFiles smallest = minimise(
      all, [&](const ProofFiles& files) { return size(files) == size(all) && files.files == all.files; }, 5000);
  for (const ProofGroup& group : parse_proof(smallest.proof, "smallest")) {
    for (const ProofBlock& block : group) EXPECT_EQ(block.payload, std::string(block.payload.size(), '\0'));
  }
}

TEST(MinimiseProof, TakesBytesThatAreNoBlocks) {
  const auto fails = [](const ProofFiles& files) { return files.proof.find("needle") != std::string::npos; };
  const ProofFiles smallest = minimise({"\x89NOLI, some hay, a needle, more hay", "ply", {"a", "b"}}, fails, 5000);
  EXPECT_EQ(smallest.proof, "needle");
  EXPECT_EQ(smallest.files.size(), 1u);
}

/// Rejects everything: files without blocks for that reason, and block files for another one.
ProofAnswer rejects_all(const ProofFiles& files) {
  const bool blocks = believes_all(files).code == 0;
  return {3, "", blocks ? fmt::format("rejected: byte {}: other cells", files.proof.size()) : "rejected: no blocks"};
}

Checkers checkers_that_differ() {
  return {std::make_unique<FakeChecker>(rejects_all), std::make_unique<FakeChecker>([](const ProofFiles&) {
            return ProofAnswer{0, ""};
          })};
}

JudgedProof judged(const ProofFiles& files, const Checkers& checkers) { return {files, judge_proof(files, checkers)}; }

TEST(MinimiseFinding, KeepsTheReasonOfThePlainChecker) {
  const Checkers checkers = checkers_that_differ();
  const std::atomic<bool> stop = false;
  const JudgedProof smallest = minimise_finding(judged(example_files(), checkers), checkers, stop, 5000);
  EXPECT_LT(smallest.files.proof.size(), example_files().proof.size());
  EXPECT_NE(rejects_all(smallest.files).words.find("other cells"), std::string::npos) << smallest.judgement.plain.words;
}

TEST(MinimiseFinding, EndsWithAProofThatCanBeReadAgain) {
  const Checkers checkers = checkers_that_differ();
  const std::atomic<bool> stop = false;
  const ProofFiles text{"no blocks at all", "ply", {"a", "b"}};
  const ProofFiles smallest = minimise_finding(judged(text, checkers), checkers, stop, 5000).files;
  EXPECT_EQ(smallest.proof.size(), 1u);
  const test::TemporaryFolder folder;
  write_proof_files(smallest, folder / "");
  EXPECT_EQ(read_proof_files(folder / "").proof, smallest.proof);
}

TEST(ReplayProof, MakesItSmallerIfThatIsAskedForAndSomethingIsWrong) {
  const Checkers differ = checkers_that_differ();
  const std::atomic<bool> stop = false;
  const JudgedProof as_it_is = replay_proof(example_files(), false, differ, stop);
  EXPECT_EQ(as_it_is.files.proof, example_files().proof);
  EXPECT_NE(as_it_is.judgement.difference, "");
  const JudgedProof smaller = replay_proof(example_files(), true, differ, stop);
  EXPECT_LT(smaller.files.proof.size(), as_it_is.files.proof.size());
  EXPECT_EQ(kind_of(smaller.judgement), kind_of(as_it_is.judgement));
  const Checkers agree{std::make_unique<FakeChecker>(rejects_all), std::make_unique<FakeChecker>(rejects_all)};
  EXPECT_EQ(replay_proof(example_files(), true, agree, stop).files.proof, example_files().proof);
}

/// Requests a stop after this many answers, like a user who interrupts.
class StopsAfter : public ProofChecker {
 public:
  StopsAfter(int answers, std::atomic<bool>& stop) : left_(answers), stop_(stop) {}
  ProofAnswer check(const ProofFiles& files) override {
    stop_ = --left_ <= 0;
    return rejects_all(files);
  }

 private:
  int left_;
  std::atomic<bool>& stop_;
};

TEST(MinimiseFinding, SaysWhatIsKeptOfWhatIsKept) {
  std::set<std::string> said;
  for (int answers = 1; answers < 8; ++answers) {
    std::atomic<bool> stop = false;
    Checkers checkers = checkers_that_differ();
    checkers.plain = std::make_unique<StopsAfter>(answers, stop);
    const JudgedProof smallest = minimise_finding(judged(example_files(), checkers), checkers, stop, 5000);
    EXPECT_TRUE(stop);
    EXPECT_EQ(smallest.judgement.plain.words, rejects_all(smallest.files).words);
    said.insert(smallest.judgement.plain.words);
  }
  EXPECT_GT(said.size(), 2u) << "of proofs of several sizes";
}

TEST(MinimiseProof, KeepsToItsBudget) {
  const ProofFiles all = example_files();
  int calls = 0;
  const auto fails = [&](const ProofFiles& files) {
    ++calls;
    return files.proof == all.proof && files.files == all.files;
  };
  const ProofFiles same = minimise(all, fails, 7);
  EXPECT_EQ(calls, 7);
  EXPECT_EQ(same.proof, all.proof);
  EXPECT_EQ(same.files, all.files);
}

TEST(ProofFiles, LeaveNothingOfAnotherTrajectory) {
  const test::TemporaryFolder folder;
  for (const ProofFiles& files : {ProofFiles{"p", "ply", {"a", "b", "c"}}, ProofFiles{"p", "obj", {"a", "b"}},
                                  ProofFiles{"p", "blocks", {"a"}}, ProofFiles{"p", "ply", {"a"}}}) {
    write_proof_files(files, folder / "");
    const ProofFiles again = read_proof_files(folder / "");
    EXPECT_EQ(again.extension, files.extension);
    EXPECT_EQ(again.files, files.files);
  }
}

TEST_F(FuzzProofs, DependsOnTheSeedAlone) {
  const auto codes = [&](int threads) {
    options.limits.threads = threads;
    plain = believes_all;
    const ProofFuzzReport report = fuzz_proofs(options);
    return std::array{report.codes.accepted, report.codes.rejected, report.judged, report.findings_total};
  };
  EXPECT_EQ(codes(1), codes(3));
}

TEST(ProofMutations, EachFindsSomethingToChange) {
  const ProofCase good = example();
  for (const ProofMutation& mutation : proof_mutations()) {
    const bool of_witness = mutation.name.find("witness") != std::string_view::npos;
    Random random(7);
    bool applied = false, changed = false;
    for (int i = 0; i < 200; ++i) {
      Mutating m{good, {&good, 1}, random, good.groups, {}, false};
      if (!mutation.apply(m)) continue;
      applied = true;
      changed = changed || m.groups != good.groups || m.frames.has_value();
    }
    EXPECT_EQ(applied, !of_witness) << mutation.name << ": there is no witness in the example";
    EXPECT_EQ(changed, !of_witness) << mutation.name;
  }
}

TEST(ProofMutations, HashesFitChangedFrames) {
  const ProofCase good = example();
  Random random(3);
  std::size_t changed = 0;
  for (int i = 0; i < 2000; ++i) {
    const ProofMutant mutant = make_mutant(good, {&good, 1}, random);
    if (mutant.mutations != "positions" || !mutant.files) continue;
    ++changed;
    EXPECT_EQ(parse_proof(mutant.proof, "mutant").size(), 2u);
  }
  EXPECT_GT(changed, 20u);
}

TEST(ProofBlocks, ComeBackAsTheyWere) {
  const ProofCase good = example();
  EXPECT_EQ(proof_bytes(good.groups), good.proof);
  for (const auto what : {Spoiled::What::number, Spoiled::What::group_hash, Spoiled::What::running_hash}) {
    EXPECT_THROW(parse_proof(proof_bytes(good.groups, {what, 1}), "spoiled"), InputError);
  }
  EXPECT_THROW(parse_proof(proof_bytes(good.groups, {Spoiled::What::no_commit, 1}), "open"), InputError);
  EXPECT_THROW(parse_proof("no proof", "text"), InputError);
}

class ClaimOracle : public testing::Test {
 protected:
  bool holds() const { return claim_holds(claim, claimed_mesh(claim, motion.mesh).value(), motion.frames); }

  ParsedClaim claim;
  FrameMotion motion = two_edges();
};

TEST_F(ClaimOracle, KnowsContact) {
  EXPECT_TRUE(holds());
  motion.frames[1][2][0] = motion.frames[1][3][0] = 0;
  EXPECT_FALSE(holds());
  claim.labels = {0, 1};
  claim.excluded = {{0, 1}};
  EXPECT_TRUE(holds()) << "nobody compares them";
}

TEST_F(ClaimOracle, KnowsDistance) {
  claim.eta = 1.5;
  EXPECT_TRUE(holds());
  claim.eta = 2;
  EXPECT_FALSE(holds()) << "as near as the distance is too near";
}

TEST_F(ClaimOracle, KnowsRings) {
  motion.mesh.edges.push_back({1, 2});  // joins the two edges
  motion.frames[1] = motion.frames[0];
  claim.eta = 4.5;
  claim.ring = 2;
  EXPECT_FALSE(holds()) << "vertex 0 and vertex 3 are three edges apart";
  claim.ring = 4;
  EXPECT_TRUE(holds());
}

TEST_F(ClaimOracle, KnowsMergedVerticesAndPoints) {
  motion.mesh = {3, {}, {{0, 1}}, {}};
  motion.frames = {{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}};
  claim.source = 1;
  EXPECT_TRUE(holds()) << "vertex 2 is of no cell";
  claim.points = true;
  EXPECT_FALSE(holds());
  claim.merged = {{2, 1}};
  EXPECT_TRUE(holds());
}

TEST_F(ClaimOracle, KnowsFeaturesOfOneCell) {
  motion.mesh = {3, {{0, 1, 2}}, {}, {}};
  motion.frames = {{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {2, 0, 0}, {1, -1, 0}}};
  EXPECT_TRUE(holds());
  claim.strict = true;
  EXPECT_FALSE(holds()) << "a corner goes through the edge opposite";
}

}  // namespace
}  // namespace noli::audit
