// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "integrator/recording.h"
#include "integrator/simulation.h"
#include "tests/integrator/scenes.h"

namespace noli::integrator {
namespace {

using testing::changed;
using testing::loop;
using testing::sheet;

Explanation explained(const Json& scene) { return explain(parse_scene(scene.dump(), "folder/s.json")); }

bool has(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

/// The reason why something is left out; "" if it is not.
std::string why(const Explanation& explanation, const std::string& what) {
  for (const LeftOut& left_out : explanation.left_out) {
    if (left_out.what == what) return left_out.why;
  }
  return "";
}

TEST(Explain, WhatIsActiveAndWhatIsLeftOut) {
  const Explanation plain = explained(sheet());
  EXPECT_EQ(plain.title, "s");
  EXPECT_TRUE(has(plain.active, "8 membranes"));
  EXPECT_TRUE(has(plain.active, "8 hinges"));
  EXPECT_EQ(why(plain, "edge springs"), "no body has edges with a stiffness that can move");
  EXPECT_EQ(why(plain, "gravity"), "its acceleration is zero");
  EXPECT_EQ(why(plain, "damping"), "no material has any");
  EXPECT_EQ(why(plain, "scripts"), "the scene has none");
  EXPECT_EQ(why(plain, "pinned vertices"), "the scene has none");
  EXPECT_EQ(why(plain, "contact forces"), "the scene has no \"contact\": a contact ends the run");
  EXPECT_EQ(why(plain, "third coordinate"), "");
}

TEST(Explain, WhatIsActiveInAScenesWithMore) {
  Json scene = sheet();
  scene["title"] = "Sheet";
  scene["gravity"] = {0, 0, -1};
  scene["record"] = "frames";
  scene["bodies"][0]["material"]["damping"] = 0.001;
  scene["bodies"][0]["material"]["width"] = 0.5;
  scene["bodies"][0]["pin"] = {0, 1, 3, 4};
  scene["bodies"][0]["forces"] = {"stretch"};
  scene["scripts"] = R"([{"body": "body0", "vertices": [8], "path": [{"t": 0, "move": [0, 0, 0]}]}])"_json;
  const Explanation e = explained(scene);
  EXPECT_EQ(e.title, "Sheet");
  for (const char* what : {"6 membranes", "gravity", "damping", "scripts", "pinned vertices"}) {
    EXPECT_TRUE(has(e.active, what)) << what;
  }
  EXPECT_EQ(why(e, "world lines in the files"), "\"record\" is \"frames\": they can be computed again");
  EXPECT_EQ(why(e, "bending of body0"), "\"forces\" does not list it");
  EXPECT_EQ(why(e, "2 forces of body0"), "all their vertices are pinned or scripted");
  EXPECT_EQ(why(e, "width of body0"), "only curves have one");
  EXPECT_EQ(why(e, "hinges"), "no sheet with a bending stiffness can move");
}

TEST(Explain, ThePlane) {
  const Explanation e = explained(loop());
  EXPECT_TRUE(has(e.active, "8 turning angles"));
  EXPECT_EQ(why(e, "third coordinate"), "the scene has dimension 2");
  EXPECT_EQ(why(e, "membranes"), "") << "there are none in the plane to be left out";
}

TEST(Explain, CurvesDoNotBendInSpace) {
  Json scene = loop();
  scene["dimension"] = 3;
  EXPECT_EQ(why(explained(scene), "bending of edges of body0"), "curves do not bend in space");
}

TEST(Explain, EveryDefaultIsListed) {
  // Each field that is missing in the scene, and not part of a default object, is listed exactly once.
  Json scene = sheet();
  scene["gravity"] = {0, 0, -1};
  const Explanation e = explained(scene);
  std::set<std::string> paths;
  for (const DefaultTaken& taken : e.defaults) EXPECT_TRUE(paths.insert(taken.path).second) << taken.path;
  for (const char* path : {"/title",
                           "/about",
                           "/dimension",
                           "/window",
                           "/seed",
                           "/record",
                           "/frame_rate",
                           "/steps",
                           "/step_factor",
                           "/allow_unstable",
                           "/gravity_step",
                           "/most_breakpoints",
                           "/scripts",
                           "/contact",
                           "/bodies/0/name",
                           "/bodies/0/mesh/grid/diagonals",
                           "/bodies/0/array/counts",
                           "/bodies/0/array/spacing",
                           "/bodies/0/deform/stretch",
                           "/bodies/0/deform/twist",
                           "/bodies/0/transform/scale",
                           "/bodies/0/transform/rotate",
                           "/bodies/0/transform/translate",
                           "/bodies/0/perturb",
                           "/bodies/0/velocity",
                           "/bodies/0/spin",
                           "/bodies/0/material/poisson",
                           "/bodies/0/material/width",
                           "/bodies/0/material/bending",
                           "/bodies/0/material/damping",
                           "/bodies/0/material/bending_damping",
                           "/bodies/0/patches",
                           "/bodies/0/forces",
                           "/bodies/0/steps/stretch",
                           "/bodies/0/steps/bend",
                           "/bodies/0/pin"}) {
    EXPECT_EQ(paths.erase(path), 1u) << path;
  }
  EXPECT_EQ(paths, std::set<std::string>{});
}

/// Runs a scene and compares the events and breakpoints per second with the prediction.
template <int Dim>
void expect_prediction(const Json& document, double windows) {
  const Scene scene = parse_scene(document.dump(), "s.json");
  const Explanation e = explain(scene);
  Simulation<double, Dim> simulation(build_model<Dim>(scene).model);
  Recording<double, Dim> recording;
  Books<double, Dim> books;
  simulation.run_window(books);  // begins with half kicks
  const std::uint64_t at_start = simulation.events();
  std::size_t breakpoints = 0;
  for (int k = 0; k < windows; ++k) {
    recording.clear();
    simulation.run_window(recording, books);
    breakpoints += recording.stream().size();
  }
  const double seconds = windows * scene.window, n = static_cast<double>(e.bodies[0].vertices);
  EXPECT_NEAR(static_cast<double>(simulation.events() - at_start) / seconds, e.events, 0.02 * e.events);
  const double recorded = (static_cast<double>(breakpoints) - n * windows) / seconds;  // both ends are recorded
  EXPECT_NEAR(recorded, e.breakpoints, 0.02 * e.breakpoints);
}

TEST(Explain, PredictsWhatARunDoes) {
  Json scene = sheet();
  scene["bodies"][0]["perturb"] = 0.01;
  scene["bodies"][0]["pin"] = {"left"};
  scene["gravity"] = {0, 0, -1};
  expect_prediction<3>(scene, 8);
  scene["steps"] = "own";
  scene["gravity_step"] = 0.0017;
  expect_prediction<3>(scene, 8);
  Json ring = loop();
  ring["bodies"][0]["perturb"] = 0.01;
  expect_prediction<2>(ring, 8);
}

TEST(Explain, PredictsBytes) {
  Json scene = changed(loop(), "/duration", 2);
  const Explanation full = explained(scene);
  EXPECT_EQ(full.windows, 200);
  EXPECT_NEAR(full.bytes, full.breakpoints * 24 + 8 * 24 * 100, 1e-6 * full.bytes);
  EXPECT_EQ(full.bytes_in_all, 2 * full.bytes);
  scene["record"] = "frames";
  EXPECT_NEAR(explained(scene).bytes, 8 * 16 * 60 + 8 * 32 * 100, 1e-6);
}

TEST(Explain, WarnsOfWindowsThatAreTooLongAndOfStepsThatAreCut) {
  Json scene = changed(sheet(), "/bodies/0/material/young", 1e16);
  scene["window"] = 0.5;
  const Explanation e = explained(scene);
  ASSERT_GT(e.breakpoints_a_window, 2e6);
  EXPECT_EQ(std::count_if(e.warnings.begin(), e.warnings.end(), [](auto& w) { return w.starts_with("a window has "); }),
            1);
  const auto early = std::ranges::find_if(e.warnings, [](auto& w) { return w.starts_with("windows end early"); });
  ASSERT_NE(early, e.warnings.end());
  EXPECT_EQ(*early, "windows end early, with 4000000 breakpoints (\"most_breakpoints\")");
  const std::string cut = "some steps are as long as the window and could be longer with a longer \"window\"";
  EXPECT_FALSE(has(e.hints, cut));
  EXPECT_TRUE(has(explained(sheet()).hints, cut));
  EXPECT_TRUE(has(explained(changed(sheet(), "/allow_unstable", true)).warnings,
                  "steps above the limit of stability are accepted (\"allow_unstable\")"));
}

TEST(Explain, NotesADurationThatIsNotAWholeNumberOfWindows) {
  const auto rounded = [](double duration, double window) {
    const Explanation e = explained(changed(changed(sheet(), "/duration", duration), "/window", window));
    const auto note = std::ranges::find_if(e.warnings, [](auto& w) { return w.starts_with("\"duration\" "); });
    return note == e.warnings.end() ? "" : *note;
  };
  EXPECT_EQ(rounded(0.1, 1),
            "\"duration\" 0.1 is rounded up to 1 s, because a run consists of whole windows of 1 s (\"window\")");
  EXPECT_EQ(rounded(2.5, 1),
            "\"duration\" 2.5 is rounded up to 3 s, because a run consists of whole windows of 1 s (\"window\")");
  EXPECT_EQ(rounded(1, 1), "");
  EXPECT_EQ(rounded(0.07, 0.01), "") << "0.07 / 0.01 > 7, but only by rounding";
}

TEST(Explain, NotesMotionsAtTheStartThatHaveNoEffect) {
  Json scene = sheet();
  scene["bodies"][0]["velocity"] = {1, 0, 0};
  scene["bodies"][0]["spin"] = {0, 0, 1};
  scene["bodies"][0]["pin"] = {"left"};
  const auto idle = [&scene](const std::string& field) {
    return has(explained(scene).warnings,
               "\"" + field + "\" of body0 has no effect: all its vertices are pinned or scripted");
  };
  EXPECT_FALSE(idle("velocity"));
  EXPECT_FALSE(idle("spin"));
  scene["scripts"] =
      R"([{"body": "body0", "vertices": [1, 2, 4, 5, 7, 8], "path": [{"t": 0, "move": [0, 0, 0]}]}])"_json;
  EXPECT_TRUE(idle("velocity"));
  EXPECT_TRUE(idle("spin"));
  scene["bodies"][0].erase("velocity");
  EXPECT_FALSE(idle("velocity"));
}

TEST(Explain, NotesScriptsThatBeginAfterTheDuration) {
  Json scene = changed(changed(sheet(), "/duration", 0.1), "/window", 1);
  const auto late = [&scene](double begin) {
    scene["scripts"] =
        R"([{"body": "body0", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 6, "move": [0, 0, 1]}]}])"_json;
    scene["scripts"][0]["path"][0]["t"] = begin;
    return has(explained(scene).warnings,
               "/scripts/0 begins at 5 s, but the duration ends at 1 s: the script moves nothing of body0");
  };
  EXPECT_TRUE(late(5));
  EXPECT_FALSE(late(0.5)) << "the last window goes up to 1 s";
  EXPECT_FALSE(late(0));
}

/// A mass of 1 kg between a stiff spring, of frequency 1, and a soft one, with individual steps: the resonance of
/// integrator/resonance.h.
Json two_springs(double soft, double fast_step, double slow_step) {
  Json scene = Json::parse(R"({"noli_scene": 1, "dimension": 2, "duration": 100, "window": 10, "steps": "own",
      "bodies": [{"mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 2}},
                  "material": {"edge_stiffness": 1, "mass_per_vertex": 1}, "forces": ["stretch"],
                  "patches": [{"box": [[0, -1], [1, 1]]}], "pin": ["first", "last"]}]})");
  scene["bodies"][0]["steps"]["stretch"] = fast_step;
  scene["bodies"][0]["patches"][0]["stiffness_factor"] = soft;
  scene["bodies"][0]["patches"][0]["steps"]["stretch"] = slow_step;
  scene["allow_unstable"] = true;
  return scene;
}

TEST(Explain, WarnsOfTheMeasuredResonances) {
  struct Row {
    int p, q;      // q slow steps are p fast ones
    double first;  // smallest h2 omega2 that is unstable for one of the soft springs
  };
  for (const Row& row :
       {Row{2, 1, 1.16}, Row{3, 1, 0.81}, Row{3, 2, 0.90}, Row{4, 1, 0.62}, Row{5, 2, 0.59}, Row{10, 1, 0.26}}) {
    const auto warned = [&row](double fast_step) {
      const double slow_step = fast_step * row.p / row.q;
      for (const double soft : {0.01, 0.05, 0.1, 0.25}) {
        if (!explained(two_springs(soft, fast_step, slow_step)).resonances.empty()) return true;
      }
      return false;
    };
    double first = 0.01;
    while (!warned(first) && first < 2) first += 0.01;
    EXPECT_NEAR(first, row.first, 0.05 * row.first) << row.p << ":" << row.q;
  }
}

TEST(Explain, ResonancesAreNamed) {
  const Explanation e = explained(two_springs(0.25, 0.27, 2.7));
  ASSERT_EQ(e.resonances.size(), 1u);
  EXPECT_EQ(e.resonances[0].slow_kind, ForceKind::edge_spring);
  EXPECT_EQ(e.resonances[0].slow_step, 2.7);
  EXPECT_EQ(e.resonances[0].fast_step, 0.27);
  EXPECT_EQ(e.resonances[0].vertices, 1u);
  EXPECT_EQ(e.resonances[0].vertex, 1u);
  ASSERT_EQ(notes(e).size(), e.warnings.size() + 1);
  EXPECT_TRUE(notes(e).back().starts_with("edge_spring with step 2.7 s resonates with the oscillation"));
  EXPECT_NE(
      to_text(e).find(
          "Resonance: edge_spring with step 2.7 s resonates with the oscillation of edge_spring with step 0.27 s"),
      std::string::npos);
}

TEST(Explain, TextAndJsonSayTheSame) {
  Json scene = sheet();
  scene["gravity"] = {0, 0, -1};
  const Explanation e = explained(scene);
  const std::string text = to_text(e);
  const Json json = to_json(e);
  for (const std::string& what : e.active) EXPECT_NE(text.find("\n  " + what + "\n"), std::string::npos) << what;
  for (const LeftOut& l : e.left_out) EXPECT_NE(text.find("\n  " + l.what + ": " + l.why + "\n"), std::string::npos);
  for (const DefaultTaken& d : e.defaults) {
    EXPECT_NE(text.find("\n  " + d.path + " = " + d.value.dump() + "\n"), std::string::npos) << d.path;
    EXPECT_EQ(json["defaults"][d.path], d.value);
  }
  for (const std::string& warning : e.warnings) EXPECT_NE(text.find("\nNote: " + warning + ".\n"), std::string::npos);
  EXPECT_EQ(json["bodies"][0]["vertices"], 9);
  EXPECT_EQ(json["groups"].size(), e.groups.size());
  EXPECT_EQ(json["events_per_second"], e.events);
  EXPECT_EQ(json["left_out"].size(), e.left_out.size());
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace noli::integrator
