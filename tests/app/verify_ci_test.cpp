// SPDX-License-Identifier: Apache-2.0
//
// Tests the output for continuous integration: JUnit files and annotations.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/support/temporary_folder.h"

namespace noli::app_tests {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

class ForIntegration : public testing::Test {
 protected:
  std::vector<std::string> verify(const std::vector<double>& heights, std::vector<std::string> more) const {
    more.insert(more.begin(), "verify");
    char name = 'a';
    for (const double height : heights) {
      more.push_back(folder.write(std::string(1, name++) + " <&>.ply", two_triangles(height)));
    }
    return more;
  }

  std::string junit(const std::vector<double>& heights, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--junit", folder.path("noli.xml"), "--force"});
    run_noli(verify(heights, more));
    return test::read_text(folder.path("noli.xml"));
  }

  Folder folder;
};

TEST_F(ForIntegration, JunitHasACaseForEachStep) {
  const std::string xml = junit({1, 0.5, 0.25});
  EXPECT_NE(xml.find("tests=\"2\" failures=\"0\" errors=\"0\" skipped=\"0\""), std::string::npos) << xml;
  EXPECT_EQ(count(xml, "<testcase "), 2U);
  EXPECT_NE(xml.find("name=\"step 1 (a &lt;&amp;&gt;.ply → b &lt;&amp;&gt;.ply)\"/>"), std::string::npos) << xml;
}

TEST_F(ForIntegration, JunitFailsWhereSomethingTouchesAndSkipsWhatWasNotLookedAt) {
  const std::string xml = junit({1, 0.5, -1, 1});
  EXPECT_NE(xml.find("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("<failure type=\"contact\" message=\"3 pairs of features meet; the first at t = "),
            std::string::npos);
  EXPECT_NE(xml.find("vertex 3 × face 0 at (1, 1, "), std::string::npos) << xml;
  EXPECT_NE(xml.find("(--keep-going)"), std::string::npos) << xml;
  EXPECT_NE(junit({1, 0.5, -1, 1}, {"--keep-going"}).find("failures=\"2\" errors=\"0\" skipped=\"0\""),
            std::string::npos);
}

TEST_F(ForIntegration, JunitSkipsWhatTimeDidNotReach) {
  const std::string xml = junit(std::vector<double>(20, 1.0), {"--time-limit", "1ms"});
  EXPECT_NE(xml.find("<skipped message=\"not looked at: time limit\"/>"), std::string::npos) << xml;
  EXPECT_EQ(xml.find("<failure"), std::string::npos) << xml;
}

TEST_F(ForIntegration, JunitTellsWhatIsTooNear) {
  const std::string xml = junit({1, 0.5}, {"--min-distance", "0.75"});
  EXPECT_NE(xml.find("<failure type=\"too_near\" message=\"cell 0 and cell 1 are not more than 0.75 apart\"/>"),
            std::string::npos)
      << xml;
}

TEST_F(ForIntegration, JunitPassesNoStepWhoseDistanceWasNotLookedAt) {
  const std::string xml = junit({2, 1, 0.5, 1, -1}, {"--min-distance", "0.75", "--keep-going"});
  EXPECT_NE(xml.find("tests=\"4\" failures=\"2\" errors=\"0\" skipped=\"1\""), std::string::npos) << xml;
  EXPECT_EQ(count(xml, "<failure type=\"too_near\""), 1U);
  EXPECT_EQ(count(xml, "<failure type=\"contact\""), 1U);
  EXPECT_NE(xml.find("<skipped message=\"nothing touches; not checked for the least distance"), std::string::npos);
}

TEST_F(ForIntegration, JunitFailsWhereContactGoesOn) {
  const std::string xml = junit({1, 0, 0, 1, 2}, {"--keep-going"});
  EXPECT_NE(xml.find("tests=\"4\" failures=\"3\" errors=\"0\" skipped=\"0\""), std::string::npos) << xml;
  EXPECT_EQ(count(xml, "still meet as this one begins"), 2U) << xml;
}

TEST_F(ForIntegration, JunitAndPairsTellWhatWasNotCompared) {
  const std::string groups =
      folder.write("groups.json", R"({"groups": {"a": [[0, 2]], "b": [[3, 5]]}, "ignore": [["a", "b"]]})");
  const auto property = [](const std::string& xml) { return xml.substr(0, xml.find("</properties>")); };
  const std::string part = property(junit({1, -1}, {"--ignore", groups}));
  EXPECT_NE(part.find("<property name=\"verdict\" value=\"proved\"/>"), std::string::npos) << part;
  EXPECT_NE(part.find("nothing that is compared touches"), std::string::npos) << part;
  EXPECT_NE(property(junit({1, 0.5})).find("1 step: nothing touches ("), std::string::npos);
  const std::string pairs = run_noli(verify({1, -1}, {"--ignore", groups, "--porcelain"})).out;
  EXPECT_NE(pairs.find(" excluded=1 empty=true\n"), std::string::npos) << pairs;
  EXPECT_NE(run_noli(verify({1, 0.5}, {"--porcelain"})).out.find(" excluded=0 empty=false\n"), std::string::npos);
}

TEST_F(ForIntegration, AnnotationsNameEachStepAndEndWithTheVerdict) {
  const Process contact = run_noli(verify({1, 0.5, -1}, {"--github"}));
  EXPECT_TRUE(contact.out.starts_with("::error title=noli%3A step 2 (b <&>.ply → c <&>.ply)::3 pairs of features meet"))
      << contact.out;
  EXPECT_TRUE(contact.verdict_line().starts_with("CONTACT  step 2"));
  const Process fine = run_noli(verify({1, 0.5}, {"--github"}));
  EXPECT_TRUE(
      fine.out.starts_with("::notice title=noli%3A proved::2 frames, 1 step: nothing touches (accepted by noli_check "))
      << fine.out;
  const Process late = run_noli(verify(std::vector<double>(20, 1.0), {"--github", "--time-limit", "1ms"}));
  EXPECT_TRUE(late.out.starts_with("::error title=noli%3A undecided::")) << late.out;
}

TEST_F(ForIntegration, AnnotationsAreTenAtMost) {
  std::vector<double> heights;
  for (int k = 0; k < 14; ++k) heights.push_back(k % 2 == 0 ? 1 : -1);
  const std::string out = run_noli(verify(heights, {"--github", "--keep-going", "-q"})).out;
  EXPECT_EQ(count(out, "::error "), 10U);
  EXPECT_EQ(count(out, "::warning title=noli::3 more steps have contacts\n"), 1U) << out;
}

TEST_F(ForIntegration, AnnotationsGoWithNoOtherFormOfOutput) {
  EXPECT_EQ(run_noli(verify({1, 0.5}, {"--github", "--porcelain"})).exit_code, 3);
  EXPECT_EQ(run_noli(verify({1, 0.5}, {"--github", "--json", "-"})).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
