// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli audit stability` on this `noli`, and on faulty programs whose faults must be found.
#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "tests/app/audits/fake_noli.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"
#include "tests/support/temporary_folder.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

class AuditStability : public testing::Test {
 protected:
  std::vector<std::string> command(const std::string& row, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"audit", "stability", "--row", row, "--out", folder.path("findings")};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Expects a finding that contains `words` at the first point of a row for a faulty program.
  void found(const std::string& row, const std::string& fault, const std::string& words) const {
    const std::string program = fake_noli(folder, fault);
    const Json json = json_of(command(row, {"--points", "1", "--program", program}), 1);
    EXPECT_EQ(json["verdict"], "finding") << fault;
    const Json& point = json["rows"][0]["points"][0];
    ASSERT_GE(point["findings"].size(), 1u) << fault;
    EXPECT_NE(point["findings"][0].get<std::string>().find(words), std::string::npos) << point["findings"][0];
    EXPECT_TRUE(std::filesystem::exists(point["saved"].get<std::string>())) << point;
  }

  Folder folder;
};

TEST_F(AuditStability, WhatHoldsHolds) {
  const Json json = json_of(command("speed-contact", {"--points", "2"}), 0);
  EXPECT_EQ(json["verdict"], "no_finding");
  EXPECT_EQ(json["held"], 2);
  const Json& row = json["rows"][0];
  EXPECT_EQ(row["holds_up_to"], 1000);
  EXPECT_EQ(row["gives_first"], nullptr);
  EXPECT_GT(row["points"][0]["energy_error"], 0);
  EXPECT_LT(row["points"][0]["energy_error"], 0.05);
  EXPECT_EQ(row["points"][0]["exit_code"], 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path("findings")));
}

TEST_F(AuditStability, DrawsWhatHolds) {
  json_of(command("steps-not-allowed-contact", {"--svg", folder.path("rows.svg")}), 0);
  const std::string svg = test::read_text(folder.path("rows.svg"));
  EXPECT_NE(svg.find(">steps-not-allowed-contact<"), std::string::npos);
  EXPECT_NE(svg.find(">refused<"), std::string::npos) << "fails closed at 1";
  EXPECT_NE(svg.find("#bfe3c6"), std::string::npos) << "holds at 0.5";
  EXPECT_EQ(svg.find("#e8a39b"), std::string::npos) << "no finding";
}

TEST_F(AuditStability, WhatIsRefusedFailsClosed) {
  const Json row = json_of(command("steps-not-allowed-contact"), 0)["rows"][0];
  EXPECT_EQ(row["holds_up_to"], 0.5);
  EXPECT_EQ(row["gives_first"], "refused");
  EXPECT_EQ(row["at"], 1);
  EXPECT_EQ(row["exit_code"], 3);
}

/// A run ends at layers so deep that their steps cannot be counted, no matter how many layers are allowed.
TEST_F(AuditStability, LayersWithoutEndDoNotHang) {
  const Json row = json_of(command("thickness-all-layers-contact"), 0)["rows"][0];
  EXPECT_EQ(row["holds_up_to"], 1e-6);
  EXPECT_EQ(row["gives_first"], "too_near");
  EXPECT_EQ(row["exit_code"], 1);
}

TEST_F(AuditStability, EnergyThatGoesAstrayIsSaid) {
  for (const char* const name : {"resonance", "resonance-contact"}) {
    const Json row = json_of(command(name), 0)["rows"][0];
    EXPECT_EQ(row["gives_first"], "energy") << name;
    EXPECT_EQ(row["exit_code"], 1) << name;
    EXPECT_GT(row["points"].back()["energy_error"], 1e6) << name;
  }
}

TEST_F(AuditStability, TwoFramesAreAnsweredHoweverFarOut) {
  for (const char* const row : {"frames-magnitude-small", "frames-magnitude-small-contact", "frames-slivers-contact"}) {
    const Json json = json_of(command(row), 0);
    EXPECT_EQ(json["held"], json["points"]) << row;
  }
}

TEST_F(AuditStability, FindsAnExitCodeThatShouldNotBeZero) {
  found("steps-not-allowed", R"(case "$ALL" in *' simulate '*) exit 0;; esac)", "no document with a verdict");
}

TEST_F(AuditStability, FindsAVerdictThatIsNotThatOfTheExitCode) {
  found("speed", R"(case "$ALL" in *' simulate '*) "$NOLI" "$@" | sed 's/"no_contact"/"contact"/'; exit 0;; esac)",
        "exit 0, but the verdict is");
  found("speed", R"(case "$ALL" in *' simulate '*) "$NOLI" "$@" | sed 's/"windows": 10/"windows": 9/'; exit 0;; esac)",
        "9 of 10 windows");
}

TEST_F(AuditStability, FindsARunThatIsNotVerifiedAgain) {
  found("speed", R"(case "$ALL" in *' verify '*) echo verdict=contact; exit 1;; esac)",
        "`noli verify` says, with exit 1");
  found("speed", R"(case "$ALL" in *' verify '*) echo verdict=contact; exit 0;; esac)",
        "`noli verify` says, with exit 0");
}

/// A script that changes the last cell of each line of a series.
std::string changed_series(const std::string& figure, const std::string& last) {
  return R"(case "$ALL" in *' --figure )" + figure + R"( '*) "$NOLI" "$@"; for f in "$@"; do case "$f" in *.csv)
    awk -F, -v OFS=, 'NR > 1 {$NF = )" +
         last + R"(} {print}' "$f" > "$f.new"; mv "$f.new" "$f";; esac; done; exit 0;; esac)";
}

TEST_F(AuditStability, FindsEnergyAndMomentumThatGoAstrayUnsaid) {
  found("speed", changed_series("energy", "2 * $NF"), "exit 0, but energy");
  found("speed", changed_series("momentum", "NR * $NF"), "exit 0, but angular_momentum");
  found("speed", changed_series("energy", "\"nan\""), "exit 0, but finite");
}

TEST_F(AuditStability, FindsARunThatResumesToOtherBytes) {
  found("speed", R"(case "$ALL" in *' --resume '*) "$NOLI" "$@"; printf x >> "$4/trajectory.blocks"; exit 0;; esac)",
        "exit 0, but resume: trajectory.blocks");
}

TEST_F(AuditStability, FindsACrashAndAFailure) {
  found("speed", R"(case "$ALL" in *' simulate '*) kill -SEGV $$;; esac)", "signal 11");
  found("speed", R"(case "$ALL" in *' simulate '*) echo noli: internal error >&2; exit 4;; esac)",
        "exit 4: noli: internal");
  found("frames-offset", R"(kill -ABRT $$)", "signal 6");
}

TEST_F(AuditStability, FindsWrongAnswersAboutFrames) {
  found("frames-offset-contact", "echo verdict=proved contacts=0; exit 0", "verdict=proved contacts=0, but they touch");
  found("frames-offset", "echo verdict=contact; exit 1", "but they stay apart");
}

TEST_F(AuditStability, FindsAHangSlow) {
  const std::string program = fake_noli(folder, "sleep 600");
  const Json json =
      json_of(command("frames-offset", {"--points", "1", "--point-limit", "100ms", "--program", program}), 1);
  EXPECT_EQ(json["rows"][0]["points"][0]["exit_code"], -1);
}

TEST_F(AuditStability, ACtrlCEndsIt) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(300);
  const Process process = run_noli({"audit", "stability", "--out", folder.path("findings")}, options);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("UNDECIDED ")) << process.out;
}

TEST_F(AuditStability, BadInputIsRefused) {
  const Process process = run_noli(command("no-such-row"));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("there is no row no-such-row; choose one of stiffness-ratio, "), std::string::npos);
  EXPECT_EQ(run_noli(command("speed", {"--program", folder.path("none")})).exit_code, 3);
  EXPECT_EQ(run_noli(command("speed", {"--point-limit", "never"})).exit_code, 3);
}

TEST_F(AuditStability, TheWorkedExampleIsTrue) {
  const auto commands = worked_example("docs/audit/stability.md");
  ASSERT_EQ(commands.size(), 3u);
  expect_worked_example(commands, {{"build/release/app/noli", NOLI_COMMAND}});
}

/// The table in the documentation is the one that the command prints.
TEST_F(AuditStability, TheTableOfThePageIsTrueSlow) {
  const Process process = run_noli({"audit", "stability", "--out", folder.path("findings")});
  EXPECT_EQ(process.exit_code, 0) << process.out;
  const std::string page = read_text(std::string(NOLI_SOURCE_DIR) + "/docs/audit/stability.md");
  std::istringstream lines(process.out);
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ")) continue;
    ++rows;
    EXPECT_NE(page.find("\n" + line + "\n"), std::string::npos) << line;
  }
  EXPECT_GE(rows, 30);
}

}  // namespace
}  // namespace noli::app_tests
