// SPDX-License-Identifier: Apache-2.0
//
// Repairs the motions of `noli fuzz trajectories`, and asks the oracle what is true of them. A motion that touches
// nothing comes out byte for byte. Any other touches nothing afterwards, or the command says that it found no way. It
// says that there is no way only where fixed features really meet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "audit/fuzz/trajectories/motion_generators.h"
#include "audit/fuzz/trajectories/motion_oracle.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

namespace fs = std::filesystem;

/// Of each cell its vertices among the first `fixed`, as a cell.
audit::FrameMotion fixed_parts(const audit::FrameMotion& motion, VertexId fixed) {
  audit::FrameMotion parts = motion;
  parts.mesh.faces.clear(), parts.mesh.edges.clear(), parts.mesh.points.clear();
  for (const audit::Feature& cell : audit::cells_of(motion.mesh)) {
    audit::Feature part;
    std::ranges::copy_if(cell, std::back_inserter(part), [&](VertexId v) { return v < fixed; });
    if (part.size() == 3) parts.mesh.faces.push_back({part[0], part[1], part[2]});
    if (part.size() == 2) parts.mesh.edges.push_back({part[0], part[1]});
    if (part.size() == 1) parts.mesh.points.push_back(part[0]);
  }
  return parts;
}

class RepairFuzz : public testing::Test {
 protected:
  /// How one motion ended, of which so many vertices are fixed: "free", "done", "blocked", ...
  std::string repair(const audit::FrameMotion& motion, std::uint64_t number, VertexId fixed) const {
    const fs::path in = folder.path(fmt::format("{}", number)), out = in / "out";
    fs::create_directories(in);
    const auto frames = audit::write_frames(motion, in);
    const std::string ending = frames[0].extension().string();
    std::vector<std::string> words = {"repair",
                                      "-o",
                                      (out / "%d").string() + ending,
                                      "--json",
                                      "-",
                                      "--time-limit",
                                      "20s",
                                      "--order",
                                      "given",
                                      "--fixed-first",
                                      std::to_string(fixed)};
    for (const auto& frame : frames) words.push_back(frame.string());
    const std::string run = (in / "run").string();
    std::vector<std::string> with_run = words;
    with_run.insert(with_run.end(), {"--run", run});
    const Process process = run_noli(with_run);
    const nlohmann::json json = nlohmann::json::parse(process.out, nullptr, false);
    if (json.is_discarded()) {
      ADD_FAILURE() << number << ": " << process.exit_code << process.err;
      return "failed";
    }
    const audit::MotionTruth truth = audit::truth_of(motion);
    const std::string end = json["end"];
    if (end == "done" && json["verdict"] == "proved") {
      EXPECT_EQ(run_noli({"verify", run, "--no-check"}).exit_code, 0) << number;
    }
    if (!truth.contact) {
      EXPECT_EQ(json["copied"], frames.size()) << number << ": " << json.dump();
      EXPECT_EQ(json["verdict"], "proved") << number;
      for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(read_text((out / std::to_string(k)).string() + ending), read_text(frames[k])) << number;
      }
      return "free";
    }
    const bool at_once = truth.initial || (truth.step == 0 && truth.time && truth.time->lower() == 0);
    EXPECT_TRUE(end != "start_touches" || at_once) << number;
    EXPECT_TRUE(end == "start_touches" || !truth.initial) << number;
    const audit::MotionTruth fixed_truth = audit::truth_of(fixed_parts(motion, fixed));
    EXPECT_TRUE(end != "done" || !fixed_truth.contact) << number << ": what moves as given touches";
    EXPECT_FALSE(end == "undecided" && fixed_truth.contact && json["steps"] >= fixed_truth.step)
        << number << ": what moves as given meets, and nobody says so";
    EXPECT_TRUE(end != "blocked" || (fixed_truth.contact && json["obstacle"]["step"] == fixed_truth.step + 1))
        << number << ": " << json["obstacle"].dump();
    EXPECT_EQ(end == "start_touches", json["obstacle"].is_object() && json["obstacle"]["step"] == 0) << number;
    if (truth.initial) repair_what_is_new(words, out, number);
    if (end != "done") return end;
    // The time limit may come while the new frames are verified: the answer is then as open as the command says.
    if (json["verdict"] == "undecided") return "undecided";
    EXPECT_EQ(json["verdict"], "proved") << number;
    EXPECT_EQ(run_noli({"verify", "--order", "natural", out.string()}).exit_code, 0) << number;
    return end;
  }

  /// The same without what intersects in the first frame.
  void repair_what_is_new(std::vector<std::string> words, const fs::path& out, std::uint64_t number) const {
    words.insert(words.end(), {"--only-new", "--force"});
    const Process process = run_noli(words);
    const nlohmann::json json = nlohmann::json::parse(process.out, nullptr, false);
    ASSERT_FALSE(json.is_discarded()) << number << ": " << process.exit_code << process.err;
    EXPECT_GT(json["baseline"].get<std::uint64_t>() + (json["end"] == "start_touches" ? 1 : 0), 0u) << number;
    if (json["end"] != "done" || json["verdict"] == "undecided") return;
    EXPECT_EQ(json["verdict"], "proved") << number;
    EXPECT_EQ(run_noli({"verify", "--only-new", "--order", "natural", out.string()}).exit_code, 0) << number;
  }

  /// Motions, with some vertices `fixed` or none.
  void repair_all(std::uint64_t count, bool fixed) const {
    std::map<std::string, int> ends;
    const auto generators = audit::motion_generators();
    for (std::uint64_t number = 0; number < count; ++number) {
      audit::Random random(number);
      const audit::GeneratedMotion made = generators[number % generators.size()].make(random);
      if (made.motion.at_rest()) continue;
      const std::size_t vertices = made.motion.mesh.vertex_count;
      ++ends[repair(made.motion, number, fixed ? static_cast<VertexId>(random.below(vertices + 1)) : 0)];
    }
    std::string told;
    for (const auto& [end, times] : ends) told += fmt::format("{} {}, ", end, times);
    RecordProperty("ends", told);
    EXPECT_GT(ends["free"], 0) << told;
    EXPECT_GT(ends["done"], 0) << told;
    EXPECT_EQ(ends["blocked"] > 0, fixed) << told;
  }

  Folder folder;
};

TEST_F(RepairFuzz, FreeMotionsStayAndOthersAreMended) { repair_all(24, false); }

TEST_F(RepairFuzz, FixedPairsThatMeetAreNamed) { repair_all(24, true); }

TEST_F(RepairFuzz, SlowFreeMotionsStayAndOthersAreMended) { repair_all(trials(100, 1000), false); }

TEST_F(RepairFuzz, SlowFixedPairsThatMeetAreNamed) { repair_all(trials(50, 500), true); }

}  // namespace
}  // namespace noli::app_tests
