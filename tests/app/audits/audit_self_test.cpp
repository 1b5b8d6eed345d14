// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli audit self` on this `noli`, and on faulty programs whose faults must be found.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/app/audits/fake_noli.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

class AuditSelf : public testing::Test {
 protected:
  /// The command without data, without scenes, and with little time for fuzzers, unless `more` overrides it.
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"audit", "self", "--out", folder.path("findings")};
    const auto given = [&](const std::string& option) {
      return std::find(more.begin(), more.end(), option) != more.end();
    };
    if (!given("--for")) words.insert(words.end(), {"--for", "200ms"});
    if (!given("--scenes")) {
      std::filesystem::create_directories(folder.path("none"));
      words.insert(words.end(), {"--scenes", folder.path("none")});
    }
    if (!given("--data")) words.insert(words.end(), {"--data", folder.path("")});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  static Json part(const Json& json, const std::string& group, const std::string& name) {
    for (const Json& p : json["parts"]) {
      if (p["group"] == group && p["name"] == name) return p;
    }
    return {{"state", "absent"}};
  }

  /// Expects that the part fails for a faulty program, and that the exit code says so.
  void found(const std::string& fault, const std::string& group, const std::string& name) const {
    const Json json = json_of(command({"--program", fake_noli(folder, fault), "--only", group}), 1);
    EXPECT_EQ(json["verdict"], "finding") << fault;
    EXPECT_EQ(part(json, group, name)["state"], "failed") << fault << json.dump(2);
  }

  Folder folder;
};

TEST_F(AuditSelf, WhatIsThereHoldsAndWhatIsNotIsNamed) {
  const Json json = json_of(command(), 0);
  EXPECT_EQ(json["verdict"], "holds");
  EXPECT_EQ(json["failed"], 0);
  EXPECT_EQ(part(json, "rounding", "self-test")["state"], "held");
  EXPECT_EQ(part(json, "fuzz", "queries")["state"], "held");
  EXPECT_EQ(part(json, "proofs", "frames-offset-contact")["state"], "held");
  EXPECT_EQ(part(json, "proofs", "speed-contact")["figures"]["steps"], 10);
  for (const auto& [group, name] : {std::pair("labels", "queries"), std::pair("proofs", "scenes")}) {
    const Json skipped = part(json, group, name);
    EXPECT_EQ(skipped["state"], "skipped") << name;
    EXPECT_NE(skipped["words"], "") << name;
  }
  EXPECT_EQ(json["held"].get<std::size_t>() + json["skipped"].get<std::size_t>(), json["parts"].size());
  EXPECT_EQ(json_of(command({"--require-all"}), 2)["verdict"], "undecided");
}

TEST_F(AuditSelf, LabelsAndScenesAtHandAreAskedToo) {
  std::filesystem::create_directories(folder.path("data/queries"));
  std::filesystem::create_directories(folder.path("scenes"));
  namespace fs = std::filesystem;
  for (const auto& file : fs::directory_iterator(std::string(NOLI_SOURCE_DIR) + "/tests/kernel/queries")) {
    fs::copy_file(file.path(), fs::path(folder.path("data/queries")) / file.path().filename());
  }
  for (const char* const name : {"restitution.json", "sheet_through_sheet.json"}) {
    fs::copy_file(std::string(NOLI_SOURCE_DIR) + "/scenes/" + name, folder.path("scenes") + "/" + name);
  }
  const Json json =
      json_of(command({"--data", folder.path("data"), "--scenes", folder.path("scenes"), "--scene-time", "30s"}), 0);
  EXPECT_EQ(part(json, "labels", "queries")["figures"]["queries"], 7);
  EXPECT_EQ(part(json, "proofs", "scenes/restitution.json")["state"], "held");
  EXPECT_EQ(part(json, "proofs", "scenes/sheet_through_sheet.json")["state"], "held");
  EXPECT_EQ(part(json, "proofs", "scenes")["state"], "absent");
}

TEST_F(AuditSelf, AWrongLabelIsAFinding) {
  std::filesystem::create_directories(folder.path("data/queries"));
  std::string text =
      read_text(std::string(NOLI_SOURCE_DIR) + "/tests/kernel/queries/inside-zero-at-the-begin-vertex-face.csv");
  for (std::size_t at; (at = text.find(",1\n")) != std::string::npos;) text.replace(at, 3, ",0\n");
  folder.write("data/queries/a-vertex-face.csv", text);
  const Json json = json_of(command({"--data", folder.path("data"), "--only", "labels"}), 1);
  EXPECT_EQ(part(json, "labels", "queries")["state"], "failed");
}

TEST_F(AuditSelf, FindsEachFault) {
  found(R"(case "$ALL" in *' --version '*) "$NOLI" "$@" | sed 's/passed/FAILED: here/'; exit 0;; esac)", "rounding",
        "self-test");
  found(R"(case "$ALL" in *' fuzz '*) echo '{"verdict": "no_difference", "queries": 0}'; exit 0;; esac)", "fuzz",
        "queries");
  found(R"(case "$ALL" in *' fuzz '*) echo '{"verdict": "finding", "queries": 9}'; exit 1;; esac)", "fuzz", "queries");
  found(R"(case "$ALL" in *' fuzz '*) kill -SEGV $$;; esac)", "fuzz", "queries");
  found(R"(case "$ALL" in *' check '*) echo verdict=accepted; exit 0;; esac)", "proofs", "frames-offset-contact");
  found(R"(case "$ALL" in *' check '*) echo verdict=refuted; exit 1;; esac)", "proofs", "frames-offset");
  found(R"(case "$ALL" in *' verify '*) echo verdict=proved; exit 0;; esac)", "proofs", "frames-offset-contact");
  found(R"(case "$ALL" in *' simulate '*) "$NOLI" "$@"; : > "$4/proof.blocks"; exit 0;; esac)", "proofs",
        "speed-contact");
}

TEST_F(AuditSelf, AMissingCheckerIsNotPassedOver) {
  const std::string program = fake_noli(folder, "");
  std::filesystem::remove(folder.path("noli_check"));
  const Json json = json_of(command({"--program", program, "--only", "proofs"}), 1);
  EXPECT_EQ(part(json, "proofs", "noli_check")["state"], "failed");
}

TEST_F(AuditSelf, OnlyWhatIsAskedForIsAPart) {
  const Json json = json_of(command({"--only", "rounding,labels"}), 0);
  ASSERT_EQ(json["parts"].size(), 2u);
  EXPECT_EQ(json["skipped"], 1);
  EXPECT_EQ(json_of(command({"--only", "labels"}), 2)["verdict"], "undecided") << "nothing held";
  EXPECT_EQ(run_noli(command({"--only", "everything"})).exit_code, 3);
}

TEST_F(AuditSelf, ACtrlCEndsIt) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(300);
  const Process process = run_noli(command({"--for", "5m"}), options);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("UNDECIDED ")) << process.out;
}

TEST_F(AuditSelf, TheWorkedExampleIsTrue) {
  // The number of parts depends on whether Coq is installed.
  const auto commands = worked_example("docs/audit/self.md");
  ASSERT_EQ(commands.size(), 2u);
  const std::string without_data = std::string("env -u NOLI_DATA ") + NOLI_COMMAND;
  expect_worked_example(commands, {{"build/release/app/noli", without_data}, {"build/self", folder.path("self")}},
                        " parts ");
}

}  // namespace
}  // namespace noli::app_tests
