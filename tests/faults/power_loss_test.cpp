// SPDX-License-Identifier: Apache-2.0
//
// Lets a run lose power at random moments, between any two actions on its files. Unsynced changes are lost, reordered
// or torn (disk_model.h). Each window that the log reported by then must survive, bit for bit, and the run must resume
// to the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/faults/disk_model.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

class PowerLoss : public Simulate {
 protected:
  /// Runs a scene to its end and records what it does to its folder.
  std::vector<DiskAction> record(const std::string& file) const {
    for (const char* old : {"run", "record"}) fs::remove_all(run_path(old));
    ProcessOptions options;
    options.environment = {{"LD_PRELOAD", NOLI_RECORD_LIBRARY},
                           {"NOLI_RECORD", run_path("record")},
                           {"NOLI_RECORD_FOLDER", run_path("run")}};
    const Process process = run_noli({"simulate", file, "-o", run_path("run")}, options);
    EXPECT_EQ(process.exit_code, 0) << process.err;
    return read_actions(bytes_of(run_path("record")));
  }

  static std::size_t windows_told(const DiskAction& action) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = action.bytes.find(R"("event":"window")", at)) != std::string::npos; ++at) ++count;
    return count;
  }

  /// The content hash of each window in a folder.
  static std::vector<Sha256Digest> windows_in(const fs::path& run) {
    std::vector<Sha256Digest> windows;
    RunReader reader(run);
    while (const auto window = reader.next_window()) windows.push_back(window->group_hash);
    return windows;
  }

  /// Expects at least the windows that the log reported, and none that differ from `whole`.
  static void expect_windows(const fs::path& left, std::size_t told, const std::vector<Sha256Digest>& whole) {
    if (told == 0) return;
    const std::vector<Sha256Digest> there = windows_in(left);
    EXPECT_GE(there.size(), told);
    EXPECT_TRUE(std::ranges::mismatch(there, whole).in1 == there.end());
  }

  void expect_goes_on(const std::string& file, const fs::path& left, const std::string& whole) const {
    const Process process = run_noli({"simulate", file, "-o", left.string(), "--resume"});
    ASSERT_EQ(process.exit_code, 0) << process.err;
    EXPECT_TRUE(bytes_of(trajectory_path(left)) == whole);
    if (!fs::exists(run_path("run/proof.blocks"))) return;
    const Process checked = run_noli({"check", left.string()});
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  }

  void lose_power(const Json& json, std::size_t losses, std::size_t goes_on_each) const {
    const std::string file = scene(json);
    const std::vector<DiskAction> actions = record(file);
    ASSERT_GT(actions.size(), 100u);
    const std::string whole = blocks("run");
    const std::vector<Sha256Digest> windows = windows_in(run_path("run"));
    std::mt19937_64 random(1);
    std::size_t most_told = 0;
    for (std::size_t loss = 0; loss < losses && !HasFailure(); ++loss) {
      const std::size_t moment = random() % (actions.size() + 1);
      SCOPED_TRACE("loss " + std::to_string(loss) + " before action " + std::to_string(moment));
      DiskModel disk(run_path("run"));
      std::size_t told = 0;
      for (std::size_t i = 0; i < moment; ++i) {
        disk.apply(actions[i]);
        told += windows_told(actions[i]);
      }
      most_told = std::max(most_told, told);
      const fs::path left = run_path("left");
      fs::remove_all(left);
      disk.leave(left, random);
      expect_windows(left, told, windows);
      if (loss % goes_on_each == 0) expect_goes_on(file, left, whole);
    }
    EXPECT_GE(most_told, 2u) << "no loss came after a commit";
  }

  static Json of_record(const char* record) {
    Json json = hanging_sheet();
    json["record"] = record;
    json["duration"] = 0.08;
    return json;
  }
};

TEST_F(PowerLoss, LeavesWhatWasToldAsCommitted) {
  lose_power(of_record("full"), 100, 10);
  lose_power(of_record("frames"), 100, 10);
}

TEST_F(PowerLoss, LeavesWhatWasToldAsCommittedSlow) {
  lose_power(of_record("full"), 1000, 10);
  lose_power(of_record("frames"), 1000, 10);
  lose_power(two_cloths(), 1000, 20);
}

// --- the model itself ---

std::vector<DiskAction> synced_and_not(bool sync_name) {
  std::string record = "mkdir /f\nopen 3 577 /f/a\nwrite 3 2\nabsync 3\n";
  if (sync_name) record += "open 4 0 /f\nsync 4\nclose 4\n";
  return read_actions(record + "write 3 2\ncd");
}

std::map<std::string, int> all_that_may_be_left(bool sync_name) {
  DiskModel disk("/f");
  for (const DiskAction& action : synced_and_not(sync_name)) disk.apply(action);
  std::map<std::string, int> left;
  std::mt19937_64 random(2);
  const test::TemporaryFolder folder;
  for (int i = 0; i < 200; ++i) {
    fs::remove_all(folder / "x");
    disk.leave(folder / "x", random);
    ++left[fs::exists(folder / "x/a") ? bytes_of(folder / "x/a") : "none"];
  }
  return left;
}

TEST(DiskModel, KeepsWhatIsSyncedAndAnyPartOfTheRest) {
  std::vector<std::string> kinds;
  for (const auto& [bytes, count] : all_that_may_be_left(true)) kinds.push_back(bytes);
  EXPECT_EQ(kinds, (std::vector<std::string>{"ab", std::string("ab\0d", 4), "abc", "abcd"}));
  EXPECT_GT(all_that_may_be_left(false).at("none"), 50);
}

TEST(DiskModel, RefusesRecordsThatAreNone) {
  EXPECT_THROW(read_actions("write 3 5\nab"), std::runtime_error);
  EXPECT_THROW(read_actions("flood 3\n"), std::runtime_error);
  EXPECT_THROW(read_actions("open 3"), std::runtime_error);
}

}  // namespace
}  // namespace noli::app_tests
