// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/fuzz_trajectories.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include <noli/errors.h>
#include "audit/fuzz/trajectories/motion_generators.h"
#include "proofs/prover/verifier.h"
#include "tests/support/temporary_folder.h"

namespace noli::audit {
namespace {

/// Uses the oracle as the subject, which is never wrong.
MotionAnswer oracle_answer(const FrameMotion& motion) {
  const MotionTruth truth = truth_of(motion);
  MotionAnswer answer;
  answer.contact = truth.contact;
  answer.step = truth.step;
  answer.initial = truth.initial;
  answer.has_proof = true;
  answer.plain = answer.verified = truth.contact ? CheckerWord::refuted : CheckerWord::accepted;
  answer.shape = truth.contact ? "contact" : "apart";
  if (!truth.time) return answer;
  const std::string kind(oracle::name(answer_of(motion, truth.step, truth.first[0]).kind));
  answer.first = {truth.first[0], kind, truth.step, truth.time->lower()};
  return answer;
}

/// Misses contact at the end of a step.
MotionAnswer forgets_the_end(const FrameMotion& motion) {
  MotionAnswer answer = oracle_answer(motion);
  if (answer.first && answer.first->time == 1) answer.contact = false;
  return answer;
}

class FuzzTrajectories : public testing::Test {
 protected:
  FuzzTrajectories() {
    options.limits.seed = 3;
    options.limits.count = 48;
    options.limits.threads = 1;
    options.decide = oracle_answer;
    options.out = folder / "out";
    options.replay_command = {"noli", "fuzz", "trajectories", "--replay"};
  }

  /// The first finding against a wrong subject.
  TrajectoryFinding finding_of(const DecideMotion& decide) {
    options.decide = decide;
    const TrajectoryReport report = fuzz_trajectories(options);
    if (report.findings.empty()) throw std::runtime_error("nothing was found");
    return report.findings[0];
  }

  test::TemporaryFolder folder;
  TrajectoryOptions options;
};

TEST_F(FuzzTrajectories, FindsNothingWhereNothingIsWrong) {
  const TrajectoryReport report = fuzz_trajectories(options);
  EXPECT_EQ(report.items, 48u);
  EXPECT_EQ(report.findings_total, 0u) << report.findings[0].difference;
  EXPECT_EQ(report.shapes, 2u);
  EXPECT_FALSE(std::filesystem::exists(options.out)) << "nothing to save, and yet a folder";
}

TEST_F(FuzzTrajectories, DependsOnTheSeedAlone) {
  const auto frames = [&](int threads) {
    options.limits.threads = threads;
    options.decide = [](const FrameMotion&) {
      MotionAnswer answer;
      answer.failure = "always";
      return answer;
    };
    options.shrink_budget = 0;
    std::string bytes;
    for (const TrajectoryFinding& finding : fuzz_trajectories(options).findings) {
      bytes += finding.generator + file_bytes(finding.motion, 0);
    }
    return bytes;
  };
  EXPECT_EQ(frames(1), frames(3));
}

TEST_F(FuzzTrajectories, MakesAForgottenBorderSmall) {
  const TrajectoryFinding finding = finding_of(forgets_the_end);
  EXPECT_TRUE(finding.difference.starts_with("contact: ")) << finding.difference;
  EXPECT_EQ(finding.shrunk.frames.size(), 2u);
  EXPECT_EQ(finding.shrunk.mesh.cell_count(), 2u);
  EXPECT_LE(finding.shrunk.mesh.vertex_count, 4u);
  const FrameMotion saved = read_frames(finding.place);
  EXPECT_EQ(saved.frames, finding.shrunk.frames);
  EXPECT_TRUE(difference(saved, forgets_the_end).has_value());
  EXPECT_FALSE(difference(saved, oracle_answer).has_value());
  std::ifstream readme(finding.place / "README");
  const std::string text{std::istreambuf_iterator<char>(readme), {}};
  EXPECT_NE(text.find("noli fuzz trajectories --replay "), std::string::npos) << text;
}

TEST_F(FuzzTrajectories, FindsEveryKindOfWrongAnswer) {
  struct Fault {
    const char* kind;
    void (*spoil)(MotionAnswer& answer);
  };
  const std::vector<Fault> faults = {
      {"first moment", [](MotionAnswer& answer) { answer.initial = false; }},
      {"first contact", [](MotionAnswer& answer) { answer.first.reset(); }},
      {"first time",
       [](MotionAnswer& answer) {
         if (answer.first) answer.first->time = std::nextafter(answer.first->time, 2);
       }},
      {"kind",
       [](MotionAnswer& answer) {
         if (answer.first && answer.first->kind == "crossing") answer.first->kind = "touching";
       }},
      {"proof", [](MotionAnswer& answer) { answer.has_proof = answer.contact; }},
      {"checker",
       [](MotionAnswer& answer) {
         if (answer.plain == CheckerWord::refuted) answer.verified = CheckerWord::rejected;
       }},
      {"failure", [](MotionAnswer& answer) { answer.failure = "signal 11"; }},
  };
  options.shrink_budget = 10;
  options.max_findings = 1;
  for (const Fault& fault : faults) {
    const TrajectoryFinding finding = finding_of([&](const FrameMotion& motion) {
      MotionAnswer answer = oracle_answer(motion);
      fault.spoil(answer);
      return answer;
    });
    EXPECT_EQ(finding.difference.substr(0, finding.difference.find(':')), fault.kind) << finding.difference;
  }
}

TEST_F(FuzzTrajectories, CountsWhatWasNotDecidedInItsTime) {
  options.decide = [](const FrameMotion& motion) {
    MotionAnswer answer = oracle_answer(motion);
    answer.undecided = answer.contact;
    answer.contact = false;
    return answer;
  };
  const TrajectoryReport report = fuzz_trajectories(options);
  EXPECT_EQ(report.findings_total, 0u) << report.findings[0].difference;
  std::uint64_t undecided = 0, contact = 0;
  for (const TrajectoryTally& generator : report.generators) {
    undecided += generator.undecided;
    contact += generator.contact;
  }
  EXPECT_GT(undecided, 0u);
  EXPECT_EQ(undecided, contact);
  EXPECT_EQ(report.shapes, 1u) << "what is not decided has none";
}

TEST_F(FuzzTrajectories, FindsFeaturesThatDoNotMeetFirst) {
  const TrajectoryFinding finding = finding_of([](const FrameMotion& motion) {
    MotionAnswer answer = oracle_answer(motion);
    if (answer.first) answer.first->features[1] = answer.first->features[0];
    return answer;
  });
  EXPECT_TRUE(finding.difference.starts_with("features: ")) << finding.difference;
}

TEST_F(FuzzTrajectories, AMissingWitnessIsAFinding) {
  const FrameMotion motion = finding_of(forgets_the_end).shrunk;
  const auto without = [](const FrameMotion& one) {
    MotionAnswer answer = oracle_answer(one);
    answer.has_proof = false;
    answer.plain = answer.verified = CheckerWord::not_asked;
    return answer;
  };
  EXPECT_EQ(difference(motion, without), "proof: no witness was found");
  EXPECT_EQ(difference(motion, oracle_answer), std::nullopt);
  options.decide = without;
  options.max_findings = 0;
  const TrajectoryReport report = fuzz_trajectories(options);
  std::uint64_t without_witness = 0, contact = 0;
  for (const TrajectoryTally& generator : report.generators) {
    without_witness += generator.without_witness;
    contact += generator.contact;
  }
  EXPECT_GT(contact, 0u);
  EXPECT_EQ(without_witness, contact);
  EXPECT_EQ(report.findings_total, report.items) << "what is apart has no proof either";
}

TEST_F(FuzzTrajectories, MakesMotionsOfTheFamiliesThatAreNamed) {
  options.families = {"landing", "border"};
  const TrajectoryReport report = fuzz_trajectories(options);
  ASSERT_EQ(report.generators.size(), 2u);
  EXPECT_EQ(report.generators[0].name, "landing");
  EXPECT_EQ(report.generators[1].name, "border");
  EXPECT_EQ(report.generators[1].apart + report.generators[1].contact, 24u);
  options.families = {"landings"};
  EXPECT_THROW(fuzz_trajectories(options), std::invalid_argument);
}

/// These families produce contacts and near misses of all kinds of features, in space and in the plane.
TEST(MotionGenerators, DelicateOnesHaveBothAnswersForAllKindsOfFeatures) {
  const std::vector<std::string> names = {"last_ulp", "huge", "landing"};
  for (const MotionGenerator& generator : motion_generators(names)) {
    Random random(17);
    std::set<std::string> contacts;
    int apart = 0;
    for (int i = 0; i < 300; ++i) {
      const FrameMotion motion = generator.make(random).motion;
      const MotionTruth truth = truth_of(motion);
      apart += truth.contact ? 0 : 1;
      for (const FeatureTwo& pair : truth.first)
        contacts.insert(std::to_string(motion.dimension()) + "D " + std::to_string(pair[0].size()) +
                        std::to_string(pair[1].size()));
    }
    EXPECT_GE(apart, 30) << generator.name;
    for (const char* const kind : {"3D 13", "3D 22", "3D 12", "2D 12", "2D 11"}) {
      const std::string turned = std::string(kind).substr(0, 3) + kind[4] + kind[3];
      EXPECT_TRUE(contacts.contains(kind) || contacts.contains(turned)) << generator.name << " " << kind;
    }
  }
}

/// `last_ulp` must produce first contacts within an ulp of an end of the step, but not at it.
TEST(MotionGenerators, LastUlpsMeetThere) {
  const std::vector<std::string> names = {"last_ulp"};
  Random random(18);
  int last = 0, first = 0;
  for (int i = 0; i < 300; ++i) {
    const MotionTruth truth = truth_of(motion_generators(names)[0].make(random).motion);
    if (!truth.time || truth.time->compare(0) == 0 || truth.time->compare(1) == 0) continue;
    last += truth.time->compare(1 - 0x1p-50) > 0 ? 1 : 0;
    first += truth.time->compare(0x1p-50) < 0 ? 1 : 0;
  }
  EXPECT_GE(last, 10);
  EXPECT_GE(first, 10);
}

TEST_F(FuzzTrajectories, KeepsOneMotionOfEachShape) {
  options.corpus = folder / "corpus";
  std::filesystem::create_directory(*options.corpus);
  EXPECT_EQ(fuzz_trajectories(options).corpus_size, 2u);
  options.limits.seed = 4;
  EXPECT_EQ(fuzz_trajectories(options).corpus_size, 2u) << "shapes that are known are not kept again";
  options.limits.count = 1;
  options.decide = [](const FrameMotion& motion) {
    MotionAnswer answer = oracle_answer(motion);
    answer.contact = !answer.contact;
    return answer;
  };
  EXPECT_GE(fuzz_trajectories(options).findings_total, 2u) << "what is in the corpus is run first";
}

TEST(ReadFrames, RefusesAGap) {
  const test::TemporaryFolder folder;
  Random random(1);
  FrameMotion motion = motion_generators()[0].make(random).motion;
  motion.format = FrameFormat::ply_ascii;
  motion.frames.resize(1);
  for (int more = 0; more < 2; ++more) motion.frames.push_back(motion.frames[0]);
  write_frames(motion, folder.path());
  EXPECT_EQ(read_frames(folder.path()).frames.size(), 3u);
  std::filesystem::remove(folder / "frame-1.ply");
  EXPECT_THROW(read_frames(folder.path()), InputError);
  std::filesystem::rename(folder / "frame-2.ply", folder / "other.ply");
  EXPECT_EQ(read_frames(folder.path()).frames.size(), 1u) << "what has another name is none of its frames";
  std::filesystem::rename(folder / "other.ply", folder / "frame-1.obj");
  EXPECT_THROW(read_frames(folder.path()), InputError);
}

TEST(MotionOracle, StopsWhenAsked) {
  Random random(1);
  const FrameMotion motion = motion_generators()[0].make(random).motion;
  std::atomic<bool> stop = false;
  EXPECT_FALSE(truth_of(motion, &stop).stopped);
  stop = true;
  EXPECT_TRUE(truth_of(motion, &stop).stopped);
}

TEST(MotionGenerators, SayWhatTheOracleSays) {
  Random random(11);
  for (const MotionGenerator& generator : motion_generators()) {
    std::uint64_t contacts = 0;
    for (int i = 0; i < 60; ++i) {
      const GeneratedMotion made = generator.make(random);
      const MotionTruth truth = truth_of(made.motion);
      EXPECT_EQ(broken_promise(made.motion, made.planted, truth), std::nullopt) << generator.name;
      EXPECT_EQ(text_fault(made.motion), "") << generator.name;
      contacts += truth.contact ? 1 : 0;
    }
    EXPECT_TRUE(contacts > 0 || generator.name == "near_miss") << generator.name;
  }
}

TEST(MotionGenerators, PlantWhatTheyAreNamedFor) {
  Random random(12);
  std::set<double> times;
  for (const MotionGenerator& generator : motion_generators()) {
    for (int i = 0; i < 20; ++i) {
      const PlantedTruth planted = generator.make(random).planted;
      if (generator.name == "near_miss") {
        EXPECT_EQ(planted.contact, false);
      }
      if (generator.name == "border") {
        EXPECT_EQ(planted.time.value_or(1), 1);
      }
      if (generator.name == "begin_only") {
        EXPECT_EQ(planted.initial, true);
      }
      if (generator.name == "pierced") {
        EXPECT_EQ(planted.time, std::nullopt);
      }
      if (generator.name == "planted" && planted.time) times.insert(*planted.time);
    }
  }
  EXPECT_GT(times.size(), 5u);
}

/// Motions kept by `noli fuzz trajectories --corpus`, one for each way in which cells can first meet.
TEST(MotionCorpus, IsDecidedByTheVerifierAsByTheOracle) {
  std::size_t motions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(NOLI_SOURCE_DIR) + "/tests/audit/motions")) {
    const FrameMotion motion = read_frames(entry.path());
    const MotionTruth truth = truth_of(motion);
    EXPECT_EQ(text_fault(motion), "") << entry.path();
    for (std::size_t step = 0; step < motion.steps() && step <= truth.step; ++step) {
      VerifyOptions options;
      options.dimension = motion.dimension();
      options.initial = step == 0 || motion.at_rest();
      options.threads = 1;
      const VerifyResult found = verify_step(motion.mesh, motion.begin(step), motion.end(step), options);
      const bool here = truth.contact && step == truth.step;
      EXPECT_EQ(found.contact_count() > 0, here && truth.time.has_value()) << entry.path() << " step " << step;
      EXPECT_EQ(found.initial_intersections > 0, here && truth.initial) << entry.path() << " step " << step;
      if (!found.first || !here) continue;
      EXPECT_LE(truth.time->compare(found.first->first.end), 0) << entry.path();
      EXPECT_GE(truth.time->compare(found.first->first.begin), 0) << entry.path();
    }
    ++motions;
  }
  EXPECT_GE(motions, 40u);
}

TEST(MotionOracle, KnowsAnEdgeThroughAFaceAtRest) {
  FrameMotion motion;
  motion.mesh = {5, {{0, 1, 2}}, {{3, 4}}, {}};
  motion.frames = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}}};
  MotionTruth truth = truth_of(motion);
  EXPECT_TRUE(truth.initial);
  EXPECT_FALSE(truth.time.has_value()) << "no vertex meets the face, no edge an edge";
  motion.frames[0][4][2] = -0.5;
  truth = truth_of(motion);
  EXPECT_FALSE(truth.contact);
}

TEST(MotionOracle, TakesTheFirstOfSeveral) {
  FrameMotion motion;
  motion.mesh = {4, {}, {}, {0, 1, 2, 3}};
  motion.frames = {{{0, 0, 0}, {3, 0, 1}, {7, 0, 0}, {8, 0, 0}}, {{3, 0, 1}, {3, 0, 1}, {9, 0, 0}, {8, 0, 0}}};
  const MotionTruth truth = truth_of(motion);
  ASSERT_TRUE(truth.time.has_value());
  EXPECT_EQ(truth.time->lower(), 0.5);
  EXPECT_EQ(truth.first, std::vector<FeatureTwo>({{Feature{2}, Feature{3}}}));
}

}  // namespace
}  // namespace noli::audit
