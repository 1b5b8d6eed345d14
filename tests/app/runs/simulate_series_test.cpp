// SPDX-License-Identifier: Apache-2.0
//
// Tests runs whose series.h5 cannot be written: the run is complete, and `--resume` writes the file.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

class SimulateSeries : public Simulate {
 protected:
  /// A scene whose series are much larger than its motion.
  static Json many_frames() {
    Json json = resting_bar(1, 0.25);
    json["frame_rate"] = 1e5;
    return json;
  }

  /// noli without the programs beside it.
  std::string lonely_noli() const {
    fs::create_directory(folder.path("bin"));
    const std::string program = folder.path("bin/noli");
    fs::copy_file(NOLI_COMMAND, program, fs::copy_options::overwrite_existing);
    return program;
  }

  void expect_whole_run_without_series(const std::string& end) const {
    EXPECT_FALSE(fs::exists(run_path("run/series.h5")));
    EXPECT_FALSE(fs::exists(run_path("run/series.h5.part")));
    EXPECT_EQ(last_entry(run_path("run"))["end"], "done");
    EXPECT_EQ(last_entry(run_path("run"))["series"], end);
    EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["steps"], 4);
  }
};

TEST_F(SimulateSeries, NoliDoesWithoutTheProgramAndSaysSo) {
  ProcessOptions options;
  options.program = lonely_noli();
  const Process process = run_noli({"simulate", scene(many_frames()), "-o", run_path("run")}, options);
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_NE(process.out.find("series.h5 was not written: noli_series is missing"), std::string::npos) << process.out;
  expect_whole_run_without_series("unavailable");
}

#ifdef NOLI_SERIES

TEST_F(SimulateSeries, AFullDiskIsNamed) {
  const std::string file = scene(many_frames());
  ProcessOptions options;
  options.file_size = 1'000'000;
  const Process process = run_noli({"simulate", file, "-o", run_path("run")}, options);
  EXPECT_EQ(process.exit_code, 4) << process.out;
  EXPECT_NE(process.err.find("run/series.h5: not written: File too large; "), std::string::npos) << process.err;
  EXPECT_NE(process.err.find("make room on the disk of " + run_path("run")), std::string::npos) << process.err;
  expect_whole_run_without_series("failed");
  const std::string before = blocks("run");
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume"}).exit_code, 0);
  EXPECT_GT(fs::file_size(run_path("run/series.h5")), 1'000'000u);
  EXPECT_TRUE(blocks("run") == before);
}

TEST_F(SimulateSeries, AProgramThatDiesIsNamed) {
  const std::string file = scene(many_frames());
  ProcessOptions options;
  options.program = lonely_noli();
  const std::string fake = folder.write("bin/noli_series", "#!/bin/sh\nkill -SEGV $$\n");
  fs::permissions(fake, fs::perms::owner_all);
  const Process process = run_noli({"simulate", file, "-o", run_path("run")}, options);
  EXPECT_EQ(process.exit_code, 4) << process.out;
  EXPECT_NE(process.err.find("run/series.h5: not written: noli_series was ended by signal 11"), std::string::npos)
      << process.err;
  expect_whole_run_without_series("failed");
}

TEST_F(SimulateSeries, ALinkInARunIsNotFollowed) {
  const std::string file = scene(many_frames());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.5"}).exit_code, 0);
  const std::string target = folder.write("precious", "theirs");
  fs::create_symlink(target, run_path("run/series.h5.part"));
  const Process process = run_noli({"simulate", file, "-o", run_path("run"), "--resume"});
  EXPECT_EQ(process.exit_code, 3) << process.err;
  EXPECT_NE(process.err.find("run/series.h5.part is a link, which is not written to"), std::string::npos)
      << process.err;
  EXPECT_EQ(bytes_of(target), "theirs");
  fs::remove(run_path("run/series.h5.part"));
  std::ofstream(run_path("run/series.h5.part")) << "left by a kill";
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(run_path("run/series.h5.part")));
  EXPECT_GT(fs::file_size(run_path("run/series.h5")), 1'000'000u);
}

#endif

}  // namespace
}  // namespace noli::app_tests
