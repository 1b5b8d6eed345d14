// SPDX-License-Identifier: Apache-2.0
//
// `noli report`: what is in a page. How it looks in a browser is tested by viewer/test.
#include <gtest/gtest.h>

#include "noli/tests/app/simulate_fixture.h"

namespace noli::app_tests {
namespace {

/// The text of an element of the page.
std::string element(const std::string& html, const std::string& id) {
  const std::size_t at = html.find("id=\"" + id + "\"");
  const std::size_t begin = html.find('>', at) + 1, end = html.find("</script>", begin);
  EXPECT_NE(at, std::string::npos) << id;
  return html.substr(begin, end - begin);
}

class Report : public Simulate {
 protected:
  void SetUp() override {
    const Process process = run_noli({"report", "nothing.json", "-o", folder.path("probe.html")});
    built_ = process.err.find("was built without reports") == std::string::npos;
    if (!built_) GTEST_SKIP() << "skipped: this noli was built without reports (NOLI_WITH_REPORT)";
  }

  /// Where a page was written.
  std::string write(std::vector<std::string> inputs, int exit_code = 0, const std::string& complaint = "") {
    const std::string page = folder.path("page.html");
    inputs.insert(inputs.begin(), "report");
    inputs.insert(inputs.end(), {"-o", page, "--force"});
    const Process process = run_noli(inputs);
    EXPECT_EQ(process.exit_code, exit_code) << process.err;
    EXPECT_NE(process.err.find(complaint), std::string::npos) << process.err;
    return page;
  }
  Json page(const std::vector<std::string>& inputs) { return Json::parse(element(bytes_of(write(inputs)), "page")); }

  std::string frame(const std::string& name, double z) {
    return folder.write(name, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 " + std::to_string(z) + "\nf 1 2 3\np 4\n");
  }
  std::string verdict(const std::vector<std::string>& frames, int exit_code) {
    std::string json = folder.path("verdict.json");
    std::vector<std::string> words = {"verify", "--json", json};
    words.insert(words.end(), frames.begin(), frames.end());
    EXPECT_EQ(run_noli(words).exit_code, exit_code);
    return json;
  }

  bool built_ = false;
};

TEST_F(Report, OfARun) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run}).exit_code, 0);
  const std::string html = bytes_of(write({run}));
  const Json json = Json::parse(element(html, "page"));
  EXPECT_EQ(json["title"], "hanging sheet");
  EXPECT_EQ(json["verdict"]["word"], "no_contact");
  EXPECT_EQ(json["scene"]["vertices"], 49);
  EXPECT_EQ(json["scene"]["frames"], 16);  // 0, 1/60, ..., 15/60
  EXPECT_EQ(json["scene"]["times"][15], 0.25);
  EXPECT_EQ(json["scene"]["steps"]["list"].size(), 25u);
  EXPECT_EQ(json["scene"]["parts"][0]["name"], "sheet");
  EXPECT_EQ(json["plots"][0]["title"], "Energy");
  EXPECT_EQ(json["plots"][0]["times"].size(), 25u);
  EXPECT_FALSE(element(html, "motion").empty());
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("href=\"http"), std::string::npos);
  EXPECT_EQ(bytes_of(write({run})), html);
}

TEST_F(Report, OfARunThatEndsInContact) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run}).exit_code, 1);
  const Json json = page({run});
  EXPECT_EQ(json["verdict"]["word"], "contact");
  EXPECT_NE(json["verdict"]["lines"].dump().find("something touches"), std::string::npos);
}

TEST_F(Report, OfAVerdictWithItsFrames) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  const std::string result = verdict(frames, 1);
  const Json json = page({frames[0], result, frames[1]});
  EXPECT_EQ(json["verdict"]["word"], "contact");
  EXPECT_EQ(json["contacts"]["total"], 1);
  EXPECT_EQ(json["contacts"]["counts"]["vertex_face"], 1);
  EXPECT_EQ(json["contacts"]["listed"][0]["features"], Json::parse("[[3], [0, 1, 2]]"));
  EXPECT_EQ(json["scene"]["frames"], 2);
  EXPECT_FALSE(json["statement"].empty());
}

TEST_F(Report, OfAVerdictAlone) {
  const Json json = page({verdict({frame("0.obj", 2), frame("1.obj", 1)}, 0)});
  EXPECT_EQ(json["verdict"]["word"], "proved");
  EXPECT_TRUE(json["scene"].is_null());
  EXPECT_EQ(json["contacts"]["total"], 0);
}

TEST_F(Report, OfOtherResultsAndPictures) {
  const std::string result = folder.write("audit.json", R"({"verdict": "finding", "rows": [{"a": 1, "b": {"c": 2}}]})");
  const std::string picture = folder.write("a <script> picture.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  const Json json = page({result, picture, "--title", "An </script> audit"});
  EXPECT_EQ(json["title"], "An </script> audit");
  EXPECT_EQ(json["verdict"]["word"], "finding");
  EXPECT_EQ(json["results"][0]["result"]["rows"][0]["b"]["c"], 2);
  EXPECT_EQ(json["pictures"][0]["image"].get<std::string>().substr(0, 26), "data:image/svg+xml;base64,");
}

TEST_F(Report, ListsAThousandContactsAndCountsAll) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  Json result = Json::parse(bytes_of(verdict(frames, 1)));
  const Json one = result["reports"]["contacts"][0];
  for (int i = 1; i < 100'000; ++i) result["reports"]["contacts"].push_back(one);
  result["contacts"]["vertex_face"] = 100'000;
  const Json json = page({folder.write("many.json", result.dump()), frames[0], frames[1]});
  EXPECT_EQ(json["contacts"]["total"], 100'000);
  EXPECT_EQ(json["contacts"]["listed"].size(), 1000u);
}

TEST_F(Report, RefusesWhatDoesNotFit) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  const std::string result = verdict(frames, 1);
  write({frames[0], frames[1]}, 3, "no result of noli verify");
  write({result, frames[0]}, 3, "is about 2 frames, but 1 frames were given");
  write({folder.write("none.json", "{")}, 3, "is no JSON");
  write({folder.write("list.json", "[]")}, 3, "expected an object");
  write({folder.write("no.txt", "x")}, 3, "expected the folder of a run");
  Json other = Json::parse(bytes_of(result));
  other["reports"]["contacts"][0]["features"][0][0] = 4;
  write({folder.write("other.json", other.dump()), frames[0], frames[1]}, 3, "names vertex 4, but the mesh");
  other["reports"]["contacts"][0].erase("step");
  write({folder.write("damaged.json", other.dump())}, 3, "is no result of noli verify");
}

TEST_F(Report, ReplacesNothingUnasked) {
  const std::string result = folder.write("a.json", R"({"verdict": "same"})");
  const std::string there = folder.write("there.html", "mine");
  const Process process = run_noli({"report", result, "-o", there});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is there already"), std::string::npos);
  EXPECT_EQ(bytes_of(there), "mine");
  EXPECT_EQ(run_noli({"report", result, "-o", result, "--force"}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
