// SPDX-License-Identifier: Apache-2.0
//
// Tests the pages that `noli report` writes about a repair: both motions, of the files that the result names.
#include "tests/app/repair/repair_fixture.h"
#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

class RepairReport : public Repair {
 protected:
  void SetUp() override {
    if (!reports_are_there()) GTEST_SKIP() << "skipped: reports (NOLI_WITH_REPORT)";
    frames_ = falling({1, 0.5, -0.5, -0.25, 1});
    EXPECT_EQ(run_noli(repair(frames_, {"--json", result_})).exit_code, 0);
  }

  Process report(const Words& more = {}) const {
    Words words = {"report", result_, "-o", page_, "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return run_noli(words);
  }
  void refuses(const std::string& why) const {
    const Process process = report();
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
  }
  Json page() const {
    const Process process = report();
    EXPECT_EQ(process.exit_code, 0) << process.err;
    const std::string html = read_text(page_);
    const std::size_t begin = html.find('>', html.find("id=\"page\"")) + 1;
    return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
  }

  std::string result_ = folder.path("mended.json"), page_ = folder.path("mended.html");
  Words frames_;
};

TEST_F(RepairReport, ShowsBothMotions) {
  const Json json = page(), result = Json::parse(read_text(result_));
  EXPECT_EQ(json["title"], "mended");
  EXPECT_EQ(json["verdict"]["word"], "proved");
  const Json& scene = json["scene"];
  EXPECT_EQ(scene["vertices"], 12);
  EXPECT_EQ(scene["cells"]["faces"], 4);
  EXPECT_EQ(scene["frames"], result["frames"]);
  EXPECT_EQ(scene["parts"][1]["name"], "as given");
  EXPECT_EQ(scene["parts"][1]["given"], true);
  EXPECT_EQ(scene["parts"][1]["first"], 6);
  EXPECT_FALSE(scene["parts"][0].contains("given"));
  // As given, it sinks to -0.5; repaired, it does not.
  EXPECT_EQ(scene["least"][2], -0.5);
  const Json& most = json["focus"];
  EXPECT_EQ(most["features"][1][0], most["features"][0][0].get<int>() + 6);
  EXPECT_EQ(json["plots"][0]["times"].size(), result["changed"].size());
  EXPECT_FALSE(json["results"][0]["result"].contains("inputs"));
}

TEST_F(RepairReport, RefusesOtherFiles) {
  const std::string given = read_text(frames_[2]);
  folder.write("in_2.ply", two_triangles(-0.75));
  refuses("is about other frames: frame 3 was");
  folder.write("in_2.ply", given);
  EXPECT_EQ(report().exit_code, 0);
  const std::string repaired = read_text(out(1));
  folder.write("out/001.ply", two_triangles(0.375));
  refuses("is about other frames: frame 2 was");
  fs::remove(out(1));
  refuses("001.ply, which is missing");
  folder.write("out/001.ply", repaired);
  EXPECT_EQ(report().exit_code, 0);
}

TEST_F(RepairReport, RefusesWhatDoesNotFit) {
  const Process more = report({frames_[0]});
  EXPECT_EQ(more.exit_code, 3);
  EXPECT_NE(more.err.find("expected no others"), std::string::npos) << more.err;
  Json result = Json::parse(read_text(result_));
  result["outputs"][1].erase("sha256");
  folder.write("mended.json", result.dump());
  refuses("has no SHA-256 of frame 2");
  result.erase("outputs");
  folder.write("mended.json", result.dump());
  refuses("is not a result of noli repair");
}

TEST_F(RepairReport, OfARepairThatCannotBe) {
  EXPECT_EQ(run_noli(repair(frames_, {"--json", result_, "--force", "--fixed-first", "6"})).exit_code, 1);
  const Json json = page();
  EXPECT_EQ(json["verdict"]["word"], "cannot_be");
  EXPECT_EQ(json["verdict"]["tone"], "bad");
  EXPECT_NE(json["verdict"]["caveats"].dump().find("after 1 of 4 steps"), std::string::npos) << json["verdict"];
  EXPECT_EQ(json["scene"]["frames"], 2);
  EXPECT_TRUE(json["focus"].is_null());
}

TEST_F(RepairReport, OfARepairThatWentOn) {
  const Json before = Json::parse(read_text(result_)), page_before = page();
  const std::string table = read_text(folder.path("out/times.csv"));
  folder.write("out/times.csv", table.substr(0, table.find("\n002.ply") + 1));
  EXPECT_EQ(run_noli(repair(frames_, {"--json", result_, "--resume", "--force"})).exit_code, 0);
  const Json result = Json::parse(read_text(result_));
  ASSERT_GT(result["steps_before"], 0);
  // What earlier calls changed is on the page, too.
  EXPECT_EQ(result["changed"], before["changed"]);
  EXPECT_EQ(page()["plots"], page_before["plots"]);
}

TEST_F(RepairReport, SaysWhatIsNotCompared) {
  const std::string groups =
      folder.write("groups.json", R"({"groups": {"a": [[0, 2]], "b": [[3, 5]]}, "ignore": [["a", "b"]]})");
  EXPECT_EQ(run_noli(repair(frames_, {"--json", result_, "--force", "--ignore", groups})).exit_code, 0);
  const Json json = page();
  EXPECT_EQ(json["verdict"]["caveats"].size(), 1u);
  EXPECT_NE(json["verdict"]["caveats"][0].get<std::string>().find("Of the new frames: "), std::string::npos);
}

#ifdef NOLI_WITH_PNG
TEST_F(RepairReport, PicturesShowTheMotionBeforeAndAfter) {
  const auto picture = [&](const char* name, const Words& more) {
    const Process process = run_noli(Words{"export", result_, "-o", folder.path(name)} + more);
    EXPECT_EQ(process.exit_code, 0) << process.err;
    return read_text(folder.path(name));
  };
  const std::string before = picture("before.png", {"--at", "2", "--given"}),
                    after = picture("after.png", {"--at", "2"});
  // Width and height are eight bytes of the head: both can be laid side by side.
  EXPECT_EQ(before.substr(16, 8), after.substr(16, 8));
  EXPECT_TRUE(after.starts_with("\x89PNG"));
  EXPECT_NE(before, after);
  // Where it is free, both are the same.
  EXPECT_EQ(picture("free.png", {"--at", "0.5", "--given"}), picture("free_after.png", {"--at", "0.5"}));
  const auto refused = [&](const Words& more, const std::string& why) {
    const Process process = run_noli(Words{"export", result_, "-o", folder.path("no.png")} + more);
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
  };
  refused({"--at", "4.5"}, "is about the times from 0 to 4 steps");
  refused({"--at", "-1"}, "is about the times from 0 to 4 steps");
  refused({}, "expected --at TIME");
  refused({"--at", "1", "--zoom", "hat"}, "has no such body");
  refused({"--at", "1", "--from", "0,0,0"}, "--from");
}
#endif

}  // namespace
}  // namespace noli::app_tests
