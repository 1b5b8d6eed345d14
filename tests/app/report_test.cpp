// SPDX-License-Identifier: Apache-2.0
//
// Tests the content of pages of `noli report`. viewer/test tests their look in a browser.
#include <gtest/gtest.h>

#include <chrono>

#include <sys/stat.h>
#include <thread>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/worked_example.h"

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

  /// Writes a page and returns its path.
  std::string write(std::vector<std::string> inputs, int exit_code = 0, const std::string& complaint = "") {
    std::string page = folder.path("page.html");
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
    std::vector<std::string> words = {"verify", "--force", "--json", json};
    words.insert(words.end(), frames.begin(), frames.end());
    EXPECT_EQ(run_noli(words).exit_code, exit_code);
    return json;
  }

  /// The run of falling_triangle(), which ends in contact at 0.3125 s, and the result of verifying its windows.
  std::vector<std::string> run_with_contact() {
    const std::string run = run_path("run"), result = folder.path("run.json");
    EXPECT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run}).exit_code, 1);
    EXPECT_EQ(run_noli({"verify", run, "--force", "--json", result}).exit_code, 0);
    return {run, result};
  }
  /// Changes the last line of the log of a run, which records its end.
  static void change_end(const std::string& run, const Json& changes) {
    const fs::path log = fs::path(run) / "log.jsonl";
    const std::string before = bytes_of(log);
    Json end = last_entry(run);
    end.update(changes);
    std::ofstream(log, std::ios::binary) << before.substr(0, before.rfind('\n', before.size() - 2) + 1)
                                         << log_line(end);
  }
  void expect_verdict(const std::vector<std::string>& inputs, const std::string& word, const std::string& tone) {
    const Json verdict = page(inputs)["verdict"];
    EXPECT_EQ(verdict["word"], word) << verdict;
    EXPECT_EQ(verdict["tone"], tone) << verdict;
  }
  static bool says(const Json& json, const std::string& text) {
    return json["verdict"]["lines"].dump().find(text) != std::string::npos;
  }
  /// The value in the statement of a page under this name; "" if there is none.
  static std::string stated(const Json& json, const std::string& name) {
    for (const Json& pair : json["statement"]) {
      if (pair[0] == name) return pair[1];
    }
    return "";
  }

  bool built_ = false;
};

TEST_F(Report, IsOpenedInABrowserWhenAsked) {
  const std::string run = run_path("run"), page = folder.path("page.html"), told = folder.path("told");
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run, "--until", "0.02"}).exit_code, 0);
  const std::string browser = folder.write("browser", "#!/bin/sh\nprintf %s \"$1\" >'" + told + "'\n");
  fs::permissions(browser, fs::perms::owner_all);
  ProcessOptions options;
  options.environment = {{"BROWSER", browser}};
  ASSERT_EQ(run_noli({"report", run, "-o", page, "--open"}, options).exit_code, 0);
  for (int i = 0; i < 100 && bytes_of(told) != page; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(bytes_of(told), page);
  options.environment = {{"BROWSER", "/nowhere/browser"}};
  const Process without = run_noli({"report", run, "-o", page, "--open", "--force"}, options);
  EXPECT_EQ(without.exit_code, 0);
  EXPECT_NE(without.err.find("note: /nowhere/browser cannot be started; open "), std::string::npos) << without.err;
}

TEST_F(Report, OfARun) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run}).exit_code, 0);
  const std::string html = bytes_of(write({run}));
  EXPECT_LT(html.size(), 1'500'000u) << "the page itself is less than half of that, this run almost nothing";
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
  EXPECT_TRUE(says(json, "something touches"));
  EXPECT_TRUE(says(json, "upright[0] meets ")) << json["verdict"];
  EXPECT_TRUE(says(json, "at 0.3125 s"));
  EXPECT_EQ(json["focus"]["meets"], true);
  EXPECT_EQ(json["focus"]["time"], 0.3125);
  EXPECT_EQ(json["focus"]["features"].size(), 2u);
  change_end(run, {{"first", "damaged"}});
  EXPECT_TRUE(page({run})["focus"].is_null());
}

TEST_F(Report, OfARunWithoutAnyWindow) {
  const std::string run = run_path("run");
  Json falling = falling_triangle();
  falling["window"] = falling["duration"];
  ASSERT_EQ(run_noli({"simulate", scene(falling), "-o", run}).exit_code, 1);
  const Json json = page({run});
  EXPECT_EQ(json["verdict"]["word"], "contact");
  EXPECT_TRUE(says(json, "No window was committed: nothing is claimed."));
  EXPECT_TRUE(says(json, "In the first window something touches")) << json["verdict"];
  EXPECT_TRUE(says(json, "at 0.3125 s"));
  EXPECT_TRUE(json["scene"].is_null());
  EXPECT_TRUE(json["plots"].empty());
  const std::string result = folder.path("result.json");
  ASSERT_EQ(run_noli({"verify", run, "--json", result}).exit_code, 2);
  EXPECT_TRUE(page({run, result})["scene"].is_null());
  change_end(run, {{"end", "done"}});
  expect_verdict({run}, "undecided", "open");
}

TEST_F(Report, TheEndOfARunStaysWhateverVerifySays) {
  const std::vector<std::string> both = run_with_contact();
  const Json json = page(both);
  EXPECT_EQ(json["verdict"]["word"], "contact");
  EXPECT_EQ(json["verdict"]["tone"], "bad");
  EXPECT_TRUE(says(json, "noli verify says proved (run.json)"));
  EXPECT_TRUE(says(json, "at 0.3125 s"));
  EXPECT_TRUE(says(json, "run.json is about this run: the SHA-256 of each file is the same"));
  const Json alone = page({both[1]});
  EXPECT_EQ(alone["verdict"]["word"], "contact");
  EXPECT_TRUE(says(alone, "The run ends at ")) << alone["verdict"];
  for (const char* const end : {"too_near", "not_finite", "unstable", "interrupted", "done"}) {
    change_end(both[0], {{"end", end}});
    const bool stopped = end == std::string("interrupted"), done = end == std::string("done");
    expect_verdict(both, stopped ? "undecided" : done ? "proved" : end, stopped ? "open" : done ? "good" : "bad");
  }
  change_end(both[0], {{"end", "contact"}, {"first", "damaged"}});
  expect_verdict(both, "contact", "bad");
}

TEST_F(Report, ARunThatGoesOnIsNotGreen) {
  const std::vector<std::string> both = run_with_contact();
  change_end(both[0], {{"end", "done"}});
  expect_verdict({both[0]}, "no_contact", "good");
  add_entry(both[0], {{"event", "resume"}});
  expect_verdict(both, "undecided", "open");
}

TEST_F(Report, SaysWhoCameTooNear) {
  const std::vector<std::string> both = run_with_contact();
  change_end(both[0], {{"end", "too_near"}, {"too_near", {{"time", 0.5}, {"names", "vertex a[1] and face b[2]"}}}});
  EXPECT_TRUE(says(page({both[0]}), "vertex a[1] and face b[2], at 0.5 s"));
}

TEST_F(Report, SaysHowFarEnergyWentAstray) {
  const std::vector<std::string> both = run_with_contact();
  change_end(both[0], {{"end", "unstable"}, {"energy", {{"begin", 0.5}, {"there", 3}, {"time", 0.25}}}});
  EXPECT_TRUE(says(page({both[0]}), "The energy drifts: from 0.5 J to 3 J at 0.25 s."));
}

TEST_F(Report, SaysWhatIsNotCompared) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(two_cloths()), "-o", run}).exit_code, 0);
  const Json json = page({run});
  EXPECT_TRUE(says(json, "Not compared: two cells of lying whose vertices are all scripted or pinned")) << json;
  const std::string free = run_path("free");
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", free}).exit_code, 0);
  EXPECT_FALSE(says(page({free}), "Not compared"));
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
  EXPECT_TRUE(says(json, "verdict.json is about these frames: the SHA-256 of each file is the same"));
  EXPECT_NE(json["facts"].dump().find("0.obj to 1.obj"), std::string::npos);
  EXPECT_EQ(json.dump().find(folder.path("")), std::string::npos) << "where files are is nobody's matter";
}

TEST_F(Report, RefusesAResultAboutOtherFiles) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  const std::string result = verdict(frames, 1);
  write({result, frame("2.obj", 0.5), frame("3.obj", -1)}, 3, "is about other frames: frame 1 was ");
  write({result, frames[0], frame("3.obj", -1.5)}, 3, "is about other frames: frame 2 was ");
  write({result, frames[0], frame("3.obj", -1)});  // the same bytes
  write({result, frames[1], frames[0]}, 3, "pass --order natural");
  write({result, frames[1], frames[0], "--order", "given"}, 3, "frame 1 was ");
  write({result, frames[1], frames[0], "--order", "natural"});
  const std::string natural = folder.path("natural.json");
  ASSERT_EQ(run_noli({"verify", frames[1], frames[0], "--order", "natural", "--json", natural}).exit_code, 1);
  write({natural, frames[1], frames[0]});  // the order was asked for once
  Json older = Json::parse(bytes_of(result));
  older.erase("inputs");
  write({folder.write("older.json", older.dump()), frames[0], frames[1]}, 3, "does not say what it is about");
  write({folder.write("older.json", older.dump())});
  const std::vector<std::string> both = run_with_contact();
  older = Json::parse(bytes_of(both[1]));
  older["inputs"][0]["sha256"] = std::string(64, '0');
  write({both[0], folder.write("older.json", older.dump())}, 3,
        "its trajectory.blocks had SHA-256 000000000000..., but");
  older.erase("inputs");
  write({both[0], folder.write("older.json", older.dump())}, 3, "does not say what it is about");
}

TEST_F(Report, HasEveryConditionOfTheStatement) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  const std::string result = verdict(frames, 1);
  const Json json = page({result});
  // Plus two inputs, and the programs that decided and checked.
  EXPECT_EQ(json["statement"].size(), Json::parse(bytes_of(result))["statement"].size() + 4);
  EXPECT_NE(stated(json, "decided by").find("noli "), std::string::npos);
  EXPECT_NE(stated(json, "checked by").find("noli_check "), std::string::npos);
  EXPECT_NE(stated(json, "input 1").find("0.obj, "), std::string::npos);
  EXPECT_NE(stated(json, "input 2").find("SHA-256 "), std::string::npos);
  EXPECT_EQ(stated(json, "dimension"), "3");
  EXPECT_EQ(stated(json, "not compared"), "nothing");
  EXPECT_EQ(stated(json, "least distance"), "0");
  EXPECT_EQ(stated(json, "vertices that are always in one place are merged"), "no");
  EXPECT_EQ(stated(json, "stops at any contact, which need not be the earliest"), "no");
  EXPECT_TRUE(says(json, "The first is a crossing")) << json["verdict"];
  EXPECT_FALSE(says(json, "there may be more"));
  EXPECT_TRUE(json["verdict"]["caveats"].empty());
  EXPECT_EQ(json["contacts"]["settled"], true);
  const std::string first = folder.path("first.json");
  ASSERT_EQ(run_noli({"verify", "--first-only", "--merge-identical", "--json", first, frames[0], frames[1]}).exit_code,
            1);
  const Json any = page({first});
  EXPECT_EQ(stated(any, "vertices that are always in one place are merged"), "yes");
  EXPECT_EQ(stated(any, "stops at any contact, which need not be the earliest"), "yes");
  EXPECT_TRUE(says(any, "The first that was found is a crossing"));
  EXPECT_TRUE(says(any, "(first contact only): there may be more contacts, and earlier ones"));
  EXPECT_EQ(any["verdict"]["caveats"].size(), 2u) << any["verdict"];
  EXPECT_EQ(any["contacts"]["settled"], false);
}

TEST_F(Report, ShowsWhatDiffersFromDefaults) {
  const std::vector<std::string> frames = {frame("0.obj", 2), frame("1.obj", 1)};
  const auto shown = [&](const Json& json) {
    std::vector<std::string> names;
    for (const Json& row : json["statement"]) {
      if (row[0] == "notes") {
        EXPECT_EQ(row[2], row[1] != "nothing");
      } else if (row[2] == true) {
        names.push_back(row[0]);
      }
    }
    return names;
  };
  EXPECT_EQ(shown(page({verdict(frames, 0)})), std::vector<std::string>{"claim"});
  const std::string near = folder.path("near.json");
  ASSERT_EQ(run_noli({"verify", "--min-distance", "0.5", "--json", near, frames[0], frames[1]}).exit_code, 0);
  EXPECT_EQ(shown(page({near})), (std::vector<std::string>{"claim", "least distance"}));
  const std::string rest = folder.path("rest.json");
  ASSERT_EQ(run_noli({"verify", "--static", "--json", rest, frames[0], frames[1]}).exit_code, 0);
  EXPECT_EQ(shown(page({rest})),
            (std::vector<std::string>{"claim", "each frame by itself, at rest", "weaker than the default claim"}));
}

TEST_F(Report, PassesOnWhatAContactHas) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  Json result = Json::parse(bytes_of(verdict(frames, 1)));
  const Json details = {{"time", 0.5},
                        {"kind", "crossing"},
                        {"cells", Json::parse("[[1], [0]]")},
                        {"bodies", {"a", "b"}},
                        {"point", {0.0, 0.25, 0.0}}};
  result["reports"]["contacts"][0].update(details);
  const std::string path = folder.write("details.json", result.dump());
  const Json contacts = page({path})["contacts"];
  EXPECT_EQ(contacts["first"]["features"], contacts["listed"][0]["features"]);
  EXPECT_EQ(contacts["per_step"], Json::parse("[1]"));
  for (const auto& [key, value] : details.items()) {
    EXPECT_EQ(contacts["listed"][0][key], value);
    Json wrong = result;
    wrong["reports"]["contacts"][0][key] = Json::object();
    write({folder.write("wrong.json", wrong.dump())}, 3, "is not a result of noli verify");
  }
}

TEST_F(Report, PassesOnCellsThatIntersectAtFirst) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  Json result = Json::parse(bytes_of(verdict(frames, 1)));
  result["initial_intersections"] = 1;
  result["initial_reports"]["intersections"].push_back({{"cells", {0, 1}}, {"step", 1}});
  const Json json = page({folder.write("initial.json", result.dump())});
  EXPECT_EQ(json["contacts"]["intersections"], Json::parse(R"([{"step": 1, "cells": [0, 1]}])"));
  EXPECT_EQ(json["contacts"]["per_step"], Json::parse("[1]"));
  EXPECT_TRUE(says(json, "1 pair of cells intersect before anything moves"));
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
  EXPECT_EQ(json["results"][0]["name"], "audit.json");
  EXPECT_EQ(json["results"][0]["tone"], "bad");
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

TEST_F(Report, ListsTheFirstContactsOfEachStep) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1), frame("2.obj", -2)};
  Json result = Json::parse(bytes_of(verdict(frames, 1)));
  Json one = result["reports"]["contacts"][0];
  for (int i = 1; i < 2000; ++i) result["reports"]["contacts"].push_back(one);
  one["step"] = 2;
  for (int i = 0; i < 3; ++i) result["reports"]["contacts"].push_back(one);
  result["contacts"]["vertex_face"] = 2003;
  const Json listed = page({folder.write("many.json", result.dump())})["contacts"]["listed"];
  ASSERT_EQ(listed.size(), 1000u);
  EXPECT_EQ(listed[996]["step"], 1);
  EXPECT_EQ(listed[997]["step"], 2);
}

TEST_F(Report, TheWorstOfAllResultsIsAtTheHead) {
  const auto result = [&](const std::string& word) {
    return folder.write(word + ".json", Json{{"verdict", word}}.dump());
  };
  const std::string quiet = result("no_finding"), measured = result("measured"), open = result("undecided");
  expect_verdict({quiet}, "no_finding", "good");
  expect_verdict({measured}, "measured", "neutral");
  expect_verdict({open}, "undecided", "open");
  expect_verdict({result("nobody_knows")}, "nobody_knows", "open");
  expect_verdict({quiet, measured}, "no_finding", "good");
  expect_verdict({quiet, open, measured}, "undecided", "open");
  for (const char* const word :
       {"finding", "disagreement", "not_finite", "unstable", "different", "refuted", "rejected"}) {
    expect_verdict({quiet, result(word), open}, word, "bad");
  }
  for (const char* const word : {"agreement", "nothing_fails", "no_difference", "accepted", "same", "holds"}) {
    expect_verdict({result(word)}, word, "good");
  }
  EXPECT_TRUE(says(page({quiet, open}), "no_finding.json says no finding."));
  const std::string contact = verdict({frame("0.obj", 1), frame("1.obj", -1)}, 1);
  expect_verdict({quiet, contact}, "contact", "bad");
  expect_verdict({result("finding"), verdict({frame("0.obj", 2), frame("1.obj", 1)}, 0)}, "finding", "bad");
}

TEST_F(Report, KeepsTheDigitsOfSeeds) {
  const Json json = page({folder.write("a.json", R"({"seed": 18446744073709551615, "n": [-9007199254740993, 7]})")});
  EXPECT_EQ(json["results"][0]["result"]["seed"], "18446744073709551615");
  EXPECT_EQ(json["results"][0]["result"]["n"], Json::parse(R"(["-9007199254740993", 7])"));
}

TEST_F(Report, RefusesJsonThatItCannotShow) {
  const auto nested = [&](std::size_t levels) {
    return folder.write("deep.json", R"({"a":)" + std::string(levels - 1, '[') + std::string(levels - 1, ']') + "}");
  };
  write({nested(64)});
  write({nested(65)}, 3, "expected at most 64 levels");
  write({nested(200'000)}, 3, "expected at most 64 levels");
  write({folder.write("large.json", R"({"a":1e999})")}, 3, "large.json: line 1, column ");
  write({folder.write("large.json", R"({"a":1e300})")});
}

TEST_F(Report, RefusesMoreFramesThanAnybodySees) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(resting_bar(0.5, 0.25)), "-o", run}).exit_code, 0);
  write({run, "--fps", "1e300"}, 3, "1e300: expected at most 1000");
  write({run, "--fps", "1000.5"}, 3, "expected at most 1000");
  write({run, "--fps", "0"}, 3, "above 0");
  EXPECT_EQ(page({run, "--fps", "1000"})["scene"]["frames"], 501);
}

TEST_F(Report, RefusesAResultThatIsNoneOfVerify) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  const Json result = Json::parse(bytes_of(verdict(frames, 1)));
  const auto refuse = [&](const std::string& pointer, const Json& value, const std::string& complaint) {
    Json changed = result;
    changed[Json::json_pointer(pointer)] = value;
    write({folder.write("changed.json", changed.dump())}, 3, complaint);
  };
  refuse("/reports/contacts/0/features", Json::parse("[[3]]"), "not of two features");
  refuse("/reports/contacts/0/features", Json::parse("[[3], [0], [1]]"), "not of two features");
  refuse("/reports/contacts/0/features", Json::parse("[[3], []]"), "1 to 3 vertices");
  refuse("/reports/contacts/0/features", Json::parse("[[3], [0, 1, -2]]"), "expected a whole number from 0");
  refuse("/reports/contacts/0/step", 0, "in step 0 of 1");
  refuse("/reports/contacts/0/step", 2, "in step 2 of 1");
  refuse("/contacts/vertex_face", -1, "expected a whole number from 0");
  refuse("/contacts/vertex_face", 0.5, "expected a whole number from 0");
  refuse("/contacts/vertex_face", 0, "lists 1 contacts, but counts 0");
  refuse("/initial_intersections", -1, "expected a whole number from 0");
  refuse("/steps", 2, "looked at 2 of 1 steps");
  refuse("/steps_total", 2, "makes statements about 1 steps, but has 2");
  refuse("/verdict", "proved", "says proved, but counts 1 contacts");
  write({folder.write("same.json", result.dump())});
}

TEST_F(Report, RefusesAResultAboutAnotherMesh) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  Json result = Json::parse(bytes_of(verdict(frames, 1)));
  for (const char* const count : {"vertices", "faces", "edges", "points"}) {
    Json other = result;
    other[count] = other[count].get<int>() + 1;
    const std::string path = folder.write("other.json", other.dump());
    write({path, frames[0], frames[1]}, 3, std::string("is about another mesh: it has ") + other[count].dump());
    write({path});
  }
  const std::vector<std::string> both = run_with_contact();
  Json flat = Json::parse(bytes_of(both[1]));
  flat["statement"]["dimension"] = 2;
  write({both[0], folder.write("flat.json", flat.dump())}, 3, "is about 2 dimensions, but the run has 3");
}

TEST_F(Report, OfFramesWhoseVerticesWereMergedOrMadePoints) {
  const auto frame_of = [&](const std::string& name, double z) {
    return folder.write(name, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 0\nv 0 4 0\nv 4 0 0\nf 1 2 3\np 4\nl 5 6\nv 1 1 " +
                                  std::to_string(z) + "\n");
  };
  const std::vector<std::string> frames = {frame_of("0.obj", 2), frame_of("1.obj", 1)};
  const std::string result = folder.path("result.json");
  ASSERT_EQ(run_noli({"verify", "--merge-identical", "--points", "--json", result, frames[0], frames[1]}).exit_code, 0);
  const Json json = page({result, frames[0], frames[1]});
  EXPECT_EQ(stated(json, "vertices that were merged"), "3");
  EXPECT_EQ(json["scene"]["vertices"], 7);
}

TEST_F(Report, RefusesWhatDoesNotFit) {
  const std::vector<std::string> frames = {frame("0.obj", 1), frame("1.obj", -1)};
  const std::string result = verdict(frames, 1);
  write({frames[0], frames[1]}, 3, "frames need their result");
  write({result, frames[0]}, 3, "is about 2 frames, but 1 frames were given");
  write({folder.write("none.json", "{")}, 3, "is not JSON");
  write({folder.write("list.json", "[]")}, 3, "expected an object");
  write({folder.write("no.txt", "x")}, 3, "expected the folder of a run");
  const std::string run = folder.path("one"), another = folder.path("two");
  for (const std::string& path : {run, another}) fs::create_directory(path);
  write({run, another}, 3, "expected one run at most");
  write({run, frames[0]}, 3, "expected a run or frames, and not both");
  write({result, folder.write("again.json", bytes_of(result))}, 3, "expected at most one result of noli verify");
  const std::string repair = folder.write("repair.json", R"({"schema": "noli-repair"})");
  write({repair, folder.write("another.json", bytes_of(repair))}, 3, "expected at most one result of noli repair");
  write({repair, result}, 3, "a page about a repair shows the frames that it names");
  Json other = Json::parse(bytes_of(result));
  other["reports"]["contacts"][0]["features"][0][0] = 4;
  write({folder.write("other.json", other.dump()), frames[0], frames[1]}, 3, "names vertex 4, but the mesh");
  other["reports"]["contacts"][0].erase("step");
  write({folder.write("damaged.json", other.dump())}, 3, "is not a result of noli verify");
  other["statement"] = 1;
  write({folder.write("other.json", other.dump())}, 3, "is not a result of noli verify");
}

TEST_F(Report, ReplacesNothingUnasked) {
  const std::string result = folder.write("a.json", R"({"verdict": "same"})");
  const std::string there = folder.write("there.html", "mine");
  const Process process = run_noli({"report", result, "-o", there});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("exists already"), std::string::npos);
  EXPECT_EQ(bytes_of(there), "mine");
  EXPECT_EQ(run_noli({"report", result, "-o", result, "--force"}).exit_code, 3);
}

TEST_F(Report, ReplacesNothingButFiles) {
  const std::string result = folder.write("a.json", R"({"verdict": "same"})");
  const std::string mine = folder.write("mine.html", "mine"), part = folder.write("new.html.part", "mine");
  const std::string pipe = folder.path("pipe"), link = folder.path("link"), dangling = folder.path("dangling");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(mine, link);
  fs::create_symlink(folder.path("absent"), dangling);
  for (const std::string& there : {pipe, link, dangling, std::string("/dev/null")}) {
    const Process process = run_noli({"report", result, "-o", there, "--force"});
    EXPECT_EQ(process.exit_code, 3) << there;
    EXPECT_NE(process.err.find("is not a regular file"), std::string::npos) << process.err;
  }
  EXPECT_TRUE(fs::is_fifo(pipe) && fs::is_symlink(link) && fs::is_symlink(dangling));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_FALSE(fs::exists(folder.path("absent")));
  EXPECT_EQ(run_noli({"report", result, "-o", folder.path("new.html")}).exit_code, 0);
  EXPECT_EQ(bytes_of(mine) + bytes_of(part), "minemine");
}

TEST_F(Report, TheWorkedExample) {
  const auto commands = worked_example("docs/reference/report.md", "## An example");
  ASSERT_EQ(commands.size(), 3u);
  expect_worked_example(commands, {{"noli ", std::string(NOLI_COMMAND) + " "}, {"sheets", folder.path("sheets")}},
                        " frames");
  EXPECT_TRUE(fs::exists(folder.path("sheets.html")));
}

}  // namespace
}  // namespace noli::app_tests
