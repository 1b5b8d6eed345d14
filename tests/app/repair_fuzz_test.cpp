// SPDX-License-Identifier: Apache-2.0
//
// Repairs the motions of `noli fuzz trajectories`, whose truth the oracle knows: the free ones come out byte for byte,
// the others touch nothing afterwards, or the command says that it found no way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "audit/fuzz/trajectories/motion_generators.h"
#include "audit/fuzz/trajectories/motion_oracle.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

namespace fs = std::filesystem;

class RepairFuzz : public testing::Test {
 protected:
  /// How one motion ended: "free", "proved", ...
  std::string repair(const audit::FrameMotion& motion, std::uint64_t number) const {
    const fs::path in = folder.path(fmt::format("{}", number)), out = in / "out";
    fs::create_directories(in);
    const auto frames = audit::write_frames(motion, in);
    const std::string ending = frames[0].extension().string();
    std::vector<std::string> words = {
        "repair", "-o", (out / "%d").string() + ending, "--json", "-", "--time-limit", "20s", "--order", "given"};
    for (const auto& frame : frames) words.push_back(frame.string());
    const Process process = run_noli(words);
    const nlohmann::json json = nlohmann::json::parse(process.out, nullptr, false);
    if (json.is_discarded()) {
      ADD_FAILURE() << number << ": " << process.exit_code << process.err;
      return "failed";
    }
    const audit::MotionTruth truth = audit::truth_of(motion);
    const std::string end = json["end"];
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
    EXPECT_NE(end, "blocked") << number << ": nothing is fixed";
    EXPECT_EQ(end == "start_touches", json["obstacle"].is_object() && json["obstacle"]["step"] == 0) << number;
    if (end == "done") {
      EXPECT_EQ(json["verdict"], "proved") << number;
      EXPECT_EQ(run_noli({"verify", "--order", "natural", out.string()}).exit_code, 0) << number;
    }
    return end;
  }

  void repair_all(std::uint64_t count) const {
    std::map<std::string, int> ends;
    const auto generators = audit::motion_generators();
    for (std::uint64_t number = 0; number < count; ++number) {
      audit::Random random(number);
      const audit::GeneratedMotion made = generators[number % generators.size()].make(random);
      if (made.motion.at_rest()) continue;
      const std::string end = repair(made.motion, number);
      ++ends[end];
    }
    std::string told;
    for (const auto& [end, times] : ends) told += fmt::format("{} {}, ", end, times);
    RecordProperty("ends", told);
    EXPECT_GT(ends["free"], 0) << told;
    EXPECT_GT(ends["done"], 0) << told;
  }

  Folder folder;
};

TEST_F(RepairFuzz, FreeMotionsStayAndOthersAreMended) { repair_all(24); }

TEST_F(RepairFuzz, SlowFreeMotionsStayAndOthersAreMended) { repair_all(trials(200, 1000)); }

}  // namespace
}  // namespace noli::app_tests
