// SPDX-License-Identifier: Apache-2.0
//
// Tests contact in scenes: reading, errors, defaults, models and explanations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include <noli/errors.h>
#include "integrator/scene/build_model.h"
#include "integrator/scene/explain.h"
#include "tests/integrator/scenes.h"

namespace noli::integrator {
namespace {

using testing::changed;
using testing::loop;
using testing::sheet;

/// Two sheets and a pinned floor.
Json sheets(const Json& contact) {
  Json scene = sheet();
  scene["bodies"][0]["name"] = "low";
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"][1]["name"] = "high";
  scene["bodies"][1]["transform"]["translate"] = {0, 0, 1};
  scene["bodies"][2]["name"] = "floor";
  scene["bodies"][2]["transform"]["translate"] = {0, 0, -1};
  scene["bodies"][2]["pin"] = {"all"};
  scene["contact"] = contact;
  return scene;
}

template <int Dim = 3>
BuiltScene<Dim> built(const Json& scene) {
  return build_model<Dim>(parse_scene(scene.dump(), "s.json"));
}

template <int Dim = 3>
ContactSettings settings(const Json& scene) {
  return built<Dim>(scene).model.contact.value();
}

/// Least and greatest vertex mass of the sheet of 10 kg: a corner with two triangles, the middle with eight.
constexpr double light = 10.0 * 2 / 24, heavy = 10.0 * 8 / 24;
const double sheet_bound = std::sqrt(0.125) / 2;  ///< half the height of its triangles of legs 0.5

TEST(SceneContact, IsNotThereUnlessItIsSaid) {
  EXPECT_FALSE(parse_scene(sheet().dump(), "s.json").contact);
  EXPECT_FALSE(built(sheet()).model.contact);
  EXPECT_TRUE(built(sheet()).contact.empty());
}

TEST(SceneContact, DefaultsComeFromTheMeshTheMassesAndTheSpeeds) {
  Json scene = changed(sheet(), "/contact", Json::object());
  const ContactSettings still = settings(scene);
  EXPECT_EQ(still.schedule, LayerSchedule{});
  EXPECT_EQ(still.most_layers, 1000u);
  EXPECT_EQ(still.groups, std::vector<std::uint16_t>(9, 0));
  ASSERT_EQ(still.materials.size(), 1u);
  EXPECT_NEAR(still.materials[0].thickness, sheet_bound / 2, 1e-15);
  EXPECT_NEAR(still.materials[0].stiffness, heavy * 1e4, 1e-8) << "a thickness in a window of 0.01 s";
  EXPECT_NEAR(still.materials[0].step, 0.05 * std::sqrt(light / (2 * heavy * 1e4)), 1e-12);
  EXPECT_EQ(still.materials[0].restitution, 1);
  EXPECT_EQ(still.materials[0].friction, 0);
  scene["gravity"] = {0, 0, -10};
  scene["bodies"][0]["transform"]["rotate"] = {{"axis", {1, 0, 0}}, {"degrees", 90}};  // 1 m high
  scene["bodies"][0]["velocity"] = {0, 3, 4};
  scene["bodies"][0]["pin"] = {"right_top"};
  scene["scripts"] = R"([{"body": "body0", "vertices": ["right_bottom"],
                          "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 0.5, "move": [0, 0, 1]}]}])"_json;
  const double v = 5 + 2 + std::sqrt(20.0), rate = v / (sheet_bound / 2);
  EXPECT_NEAR(settings(scene).materials[0].stiffness / (heavy * rate * rate), 1, 1e-12);
}

/// Two edges in the plane, all lengths times a factor.
Json edges(double factor) {
  Json scene = R"({"noli_scene": 1, "dimension": 2, "duration": 1, "bodies": []})"_json;
  for (const double y : {0.0, 1.0}) {
    Json body = {{"mesh", {{"chain", {{"points", {{0, y * factor}, {factor, y * factor}}}, {"segments", 1}}}}},
                 {"material", {{"edge_stiffness", 1}, {"mass_per_vertex", 1}}}};
    body["name"] = y == 0 ? "low" : "high";
    scene["bodies"].push_back(body);
  }
  scene["contact"] = {{"thickness", 0.01 * factor}};
  return scene;
}

TEST(SceneContact, NeedsTheFourthPowersOfLengths) {
  for (const double factor : {1e-67, 1.0, 1e69}) EXPECT_NO_THROW(built<2>(edges(factor))) << factor;
  for (const double factor : {1e-100, 1e-70, 1e71, 1e100}) {
    try {
      built<2>(edges(factor));
      ADD_FAILURE() << factor;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("fourth powers of lengths"), std::string::npos) << error.what();
    }
  }
}

TEST(SceneContact, WhatHasNoForcesFallsWithStepsNoLongerThanThoseOfAFirstLayerUnlessTheyAreSaid) {
  Json scene = changed(sheet(), "/gravity", Json{0, 0, -10});
  const auto gravity = [&scene] { return *built(scene).model.gravity; };
  const double step = gravity().step;
  EXPECT_EQ(gravity().step_without_forces, step);
  scene["contact"] = {{"step", step / 5}, {"stiffness", 1}};
  EXPECT_EQ(gravity().step_without_forces, step / 8) << "groups have powers of two";
  EXPECT_EQ(gravity().step, step);
  scene["steps"] = "own";
  EXPECT_EQ(gravity().step_without_forces, step / 5);
  scene["contact"]["step"] = step * 4;
  EXPECT_EQ(gravity().step_without_forces, step);
  scene["contact"]["step"] = step / 5;
  scene["gravity_step"] = step;
  EXPECT_EQ(gravity().step_without_forces, step);
}

TEST(SceneContact, InThePlaneTheLengthOfEdgesBounds) {
  const Json scene = changed(loop(), "/contact", Json::object());
  EXPECT_NEAR(settings<2>(scene).materials[0].thickness, std::sin(std::numbers::pi / 8) / 4, 1e-15);
}

TEST(SceneContact, TheRestShapeBoundsNotThatOfTheStart) {
  Json scene = changed(sheet(), "/contact", Json::object());
  scene["bodies"][0]["transform"]["scale"] = 2;
  scene["bodies"][0]["deform"]["stretch"] = {0.1, 0.1, 1};
  EXPECT_NEAR(settings(scene).materials[0].thickness, sheet_bound, 1e-15);
}

TEST(SceneContact, CellsThatCannotMoveDoNotBound) {
  Json scene = sheets(Json::object());
  scene["bodies"][2]["mesh"]["grid"]["cells"] = {100, 100};
  EXPECT_NEAR(settings(scene).materials[0].thickness, sheet_bound / 2, 1e-15);
}

/// A sheet of 8 x 8 cells, 16 times finer at one place.
Json graded(const Json& contact) {
  Json scene = sheets(contact);
  scene["bodies"][0]["mesh"]["grid"]["cells"] = {8, 8};
  scene["bodies"][0]["mesh"]["grid"]["refine"] = {{"at", {0.1, 0.2}}, {"factor", 16}};
  return scene;
}

TEST(SceneContact, WhatIsFineInOnePlaceIsOfClassesThere) {
  const Json scene = graded({{"stiffness", 100}});
  const BuiltScene<3> whole = built(scene);
  const ContactSettings& s = *whole.model.contact;
  ASSERT_EQ(s.class_count, 5) << "2^0 to 2^-4 of the height";
  ASSERT_EQ(s.classes.size(), whole.model.x.size());
  const VertexId corner = 0, high = whole.bodies[1].first;
  const auto fine = static_cast<VertexId>(std::max_element(s.classes.begin(), s.classes.end()) - s.classes.begin());
  EXPECT_EQ(s.classes[corner], 0);
  EXPECT_EQ(s.classes[high], 0);
  EXPECT_EQ(s.classes[fine], 4);
  const auto of = [&](const std::vector<VertexId>& a, const std::vector<VertexId>& b) {
    return s.materials.at(s.material(a, b));
  };
  EXPECT_EQ(of({corner}, {fine, corner}), of({fine}, {corner})) << "a feature is of its finest vertex's class";
  EXPECT_EQ(of({fine}, {corner}), of({corner}, {fine}));
  EXPECT_GT(of({corner}, {corner}).thickness, 8 * of({corner}, {fine}).thickness);
  EXPECT_GT(of({corner}, {corner}).step, 8 * of({fine}, {fine}).step);
  EXPECT_GT(of({corner}, {high}).thickness, 8 * of({fine}, {high}).thickness);
  for (const BuiltContact& c : whole.contact) {
    const ContactMaterial& m = s.materials[static_cast<std::size_t>(&c - whole.contact.data())];
    EXPECT_LT(m.thickness, c.bound);
    EXPECT_NEAR(m.step, 0.05 * std::sqrt(c.least_mass / (2 * m.stiffness)), 1e-15);
  }
}

TEST(SceneContact, AThicknessForAllIsBelowWhatTheFinestClassAllows) {
  EXPECT_NO_THROW(built(graded({{"thickness", 1e-4}})));
  const ContactSettings s = settings(graded({{"thickness", 1e-4}, {"stiffness", 10}}));
  EXPECT_TRUE(std::all_of(s.materials.begin(), s.materials.end(), [](auto& m) { return m.thickness == 1e-4; }));
  EXPECT_GT(s.materials.size(), 1u) << "steps differ still";
  EXPECT_THROW(built(graded({{"thickness", 0.02}})), InputError);
  EXPECT_NO_THROW(built(sheets({{"thickness", 0.02}})));
}

TEST(SceneContact, ClassesOfWhatIsExcludedAreAllExcluded) {
  const ContactSettings s = settings(graded(R"({"exclude": [["low", "high"]]})"_json));
  for (std::uint8_t a = 0; a < s.class_count; ++a) {
    for (std::uint8_t b = 0; b < s.class_count; ++b) {
      EXPECT_EQ(s.material_of[s.place(0, 1, a, b)], ContactSettings::excluded);
      EXPECT_EQ(s.material_of[s.place(1, 0, a, b)], ContactSettings::excluded);
    }
  }
}

TEST(SceneContact, WhatIsSaidIsTaken) {
  const Json contact = R"({"thickness": 0.05, "stiffness": 200, "stability": 0.1, "newton_restitution": 0.5,
      "friction": 0.25, "most_layers": 7, "inclusion_exclusion": true,
      "layers": {"thickness_exponent": 0.5, "stiffness_exponent": 2.75, "step_exponent": 1.75}})"_json;
  ContactSettings s = settings(changed(sheet(), "/contact", contact));
  EXPECT_EQ(s.materials[0].thickness, 0.05);
  EXPECT_EQ(s.materials[0].stiffness, 200);
  EXPECT_NEAR(s.materials[0].step, 0.1 * std::sqrt(light / 400), 1e-16);
  EXPECT_EQ(s.materials[0].restitution, 0.25);
  EXPECT_EQ(s.materials[0].friction, 0.25);
  EXPECT_EQ(s.most_layers, 7u);
  EXPECT_TRUE(s.inclusion_exclusion);
  EXPECT_EQ(s.schedule, (LayerSchedule{2, 11, 7}));
  s = settings(changed(sheet(), "/contact", R"({"step": 0.001, "stiffness": 200, "restitution": 0})"_json));
  EXPECT_EQ(s.materials[0].step, 0.001);
  EXPECT_EQ(s.materials[0].restitution, 0);
}

TEST(SceneContact, PairsHaveWhatIsSaidOfThemAndTheRestOfAll) {
  const ContactSettings s = settings(sheets(R"({"stiffness": 100, "step": 0.001, "restitution": 0.5, "pairs": [
      {"bodies": ["high", "low"], "friction": 0.5, "stability": 0.02},
      {"bodies": ["floor", "low"], "thickness": 0.01, "newton_restitution": 0.1}],
      "exclude": [["high", "high"]]})"_json));
  ASSERT_EQ(s.group_count, 3);
  EXPECT_EQ(s.materials.size(), 3u);
  EXPECT_EQ(s.groups[8], 0);
  EXPECT_EQ(s.groups[9], 1);
  EXPECT_EQ(s.groups[26], 2);
  const auto of = [&](VertexId i, VertexId j) { return s.materials.at(s.material(std::array{i}, std::array{j})); };
  EXPECT_EQ(of(0, 9), of(9, 0));
  EXPECT_EQ(of(0, 9).friction, 0.5);
  EXPECT_NEAR(of(0, 9).step, 0.02 * std::sqrt(light / 200), 1e-16) << "its stability, not the step of all";
  EXPECT_EQ(of(0, 9).restitution, 0.5);
  EXPECT_EQ(of(0, 18).thickness, 0.01);
  EXPECT_NEAR(of(0, 18).restitution, 0.01, 1e-17);
  EXPECT_EQ(of(0, 18).step, 0.001);
  EXPECT_EQ(of(0, 0), of(9, 18)) << "that of all";
  EXPECT_EQ(s.material(std::array{VertexId{9}}, std::array{VertexId{10}}), ContactSettings::excluded);
  EXPECT_EQ(s.material(std::array{VertexId{18}}, std::array{VertexId{19}}), ContactSettings::excluded)
      << "nothing there can move";
}

struct Bad {
  const char* contact;
  const char* message;
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.contact; }

class BadContact : public ::testing::TestWithParam<Bad> {};

TEST_P(BadContact, IsAnsweredWithThePathAndWhatWasExpected) {
  try {
    built(sheets(Json::parse(GetParam().contact)));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), std::string("s.json: /contact") + GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fields, BadContact,
    ::testing::Values(
        Bad{"true", ": expected an object, found true"},
        Bad{R"({"thicknes": 1})", "/thicknes: unknown field; the nearest known one is \"thickness\""},
        Bad{R"({"thickness": 0})", "/thickness: expected a number greater than 0 [m], found 0"},
        Bad{R"({"thickness": 0.2})",
            "/thickness: expected less than 0.17677669529663687 [m], half the least height at rest of the cells with a "
            "free vertex of low, found 0.2; the largest that works is 0.17677669529663684"},
        Bad{R"({"thickness": 0.17677669529663687})",
            "/thickness: expected less than 0.17677669529663687 [m], half the least height at rest of the cells with a "
            "free vertex of low, found 0.17677669529663687; the largest that works is 0.17677669529663684"},
        Bad{R"({"pairs": [{"bodies": ["low", "floor"], "thickness": 1}]})",
            "/pairs/0/thickness: expected less than 0.17677669529663687 [m], half the least height at rest of the "
            "cells with a free vertex of low and floor, found 1; the largest that works is 0.17677669529663684"},
        Bad{R"({"stiffness": 0})", "/stiffness: expected a number greater than 0 [N/m], found 0"},
        Bad{R"({"stiffness": 1e90})",
            "/stiffness: expected a step of contact that can be counted over the duration, found "
            "3.227486121839514e-47 [s]: too stiff, or too light"},
        Bad{R"({"step": 0.02})", "/step: expected at most the window, 0.01 [s], found 0.02"},
        Bad{R"({"step": 0.01, "stiffness": 2000})",
            "/step: expected at most 0.007216878364870323 [s], above which a bounce gains energy without end, or "
            "\"allow_unstable\": true, found 0.01"},
        Bad{R"({"stability": 0.75})",
            "/stability: expected at most 0.5, above which a bounce gains energy without end, or \"allow_unstable\": "
            "true, found 0.75"},
        Bad{R"({"step": 0.01, "stability": 0.05})", ": expected at most one of the fields \"step\", \"stability\""},
        Bad{R"({"restitution": 1, "newton_restitution": 1})",
            ": expected at most one of the fields \"restitution\", \"newton_restitution\""},
        Bad{R"({"restitution": 1.01})", "/restitution: expected a number not greater than 1, found 1.01"},
        Bad{R"({"restitution": -0.01})", "/restitution: expected a number not less than 0, found -0.01"},
        Bad{R"({"newton_restitution": 2})", "/newton_restitution: expected a number not greater than 1, found 2"},
        Bad{R"({"friction": -0.1})", "/friction: expected a number not less than 0, found -0.1"},
        Bad{R"({"most_layers": 0})", "/most_layers: expected a number not less than 1, found 0"},
        Bad{R"({"most_layers": 1000001})", "/most_layers: expected a number not greater than 1000000, found 1000001"},
        Bad{R"({"layers": {"thickness_exponent": 0.3}})",
            "/layers/thickness_exponent: expected a multiple of 1/4, found 0.3"},
        Bad{R"({"layers": {"thickness_exponent": 0}})",
            "/layers/thickness_exponent: expected a number greater than 0, found 0"},
        Bad{R"({"layers": {"thickness_exponent": 2, "stiffness_exponent": 2.75, "step_exponent": 3}})",
            "/layers/stiffness_exponent: expected at least 3, 2 * thickness_exponent - 1, found 2.75: the layers' "
            "energies, stiffness * thickness^2, have a finite sum, so a fast impact gets through"},
        Bad{R"({"layers": {"thickness_exponent": 1.5}})",
            "/layers/step_exponent: expected more than 1.5, the thickness_exponent, found 1.5: deep layers could be "
            "passed between two of their kicks"},
        Bad{R"({"exclude": [["low", "hihg"]]})",
            "/exclude/0/1: no body has the name \"hihg\"; the nearest is \"high\""},
        Bad{R"({"exclude": [["low"]]})", "/exclude/0: expected at least 2 items, found [\"low\"]"},
        Bad{R"({"pairs": [{"bodies": ["flor", "low"]}]})",
            "/pairs/0/bodies/0: no body has the name \"flor\"; the nearest is \"floor\""},
        Bad{R"({"pairs": [{"bodies": ["low", "high"]}, {"bodies": ["high", "low"]}]})",
            "/pairs/1/bodies: expected bodies that no other pair has, found [\"high\",\"low\"]"},
        Bad{R"({"pairs": [{"bodies": ["low", "high"]}], "exclude": [["high", "low"]]})",
            "/pairs/0/bodies: expected bodies that \"exclude\" does not name"},
        Bad{R"({"pairs": [{"friction": 1}]})", "/pairs/0: expected the field \"bodies\" (their names)"}));

TEST(SceneContact, IsRefusedWhereNumbersAreTooCoarseForIt) {
  Json scene = sheets(R"({"thickness": 0.01})"_json);
  const auto move_to = [&scene](double x) { scene["bodies"][0]["transform"]["translate"] = {x, 0, 0}; };
  move_to(1e9);
  EXPECT_EQ(settings(scene).materials[0].thickness, 0.01);
  move_to(1e13);
  try {
    settings(scene);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/contact/thickness: expected more than 36.4 where"), std::string::npos)
        << error.what();
  }
}

TEST(SceneContact, TheLargestThicknessThatIsNamedWorks) {
  EXPECT_EQ(settings(sheets(R"({"thickness": 0.17677669529663684})"_json)).materials[0].thickness, 0.17677669529663684);
}

TEST(SceneContact, TheLargestThicknessThatIsNamedWorksForAllPairs) {
  Json scene = sheets(R"({"thickness": 10, "pairs": [{"bodies": ["low", "high"], "thickness": 0.1}]})"_json);
  scene["bodies"][0]["mesh"]["grid"]["cells"] = {4, 4};
  scene["bodies"][1]["mesh"]["grid"]["cells"] = {8, 8};
  const auto refused = [&scene]() -> std::string {
    try {
      settings(scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto named = [](const std::string& error) { return std::stod(error.substr(error.rfind(' '))); };
  const std::string all = refused();
  EXPECT_NE(all.find("/contact/thickness: expected less than 0.044"), std::string::npos) << all;
  EXPECT_NE(all.find(" of high, found 10;"), std::string::npos) << "the pair of low with itself allows more: " << all;
  scene["contact"]["thickness"] = named(all);
  const std::string pair = refused();
  EXPECT_NE(pair.find("/contact/pairs/0/thickness: expected less than 0.044"), std::string::npos) << pair;
  EXPECT_NE(pair.find(" of low and high, found 0.1;"), std::string::npos) << pair;
  scene["contact"]["pairs"][0]["thickness"] = named(pair);
  EXPECT_EQ(refused(), "");
}

TEST(SceneContact, ADefaultStiffnessThatCannotBeUsedSaysWhereItIsFrom) {
  Json scene = sheets(R"({"thickness": 0.01})"_json);
  scene["bodies"][0]["velocity"] = {0, 0, 1e60};
  try {
    settings(scene);
    FAIL();
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("/contact/stiffness: expected a step of contact that can be counted"), std::string::npos)
        << said;
    EXPECT_NE(
        said.find("no stiffness is given, and its default, 3.33333e+124 [N/m], is the greatest mass of a vertex, "
                  "3.33333 kg, over the square of the time, 1e-62 s, to cross a thickness of 0.01 m at 1e+60 m/s"),
        std::string::npos)
        << said;
  }
}

TEST(SceneContact, ADefaultStiffnessBeyondTheRangeOfDoubleSaysWhereItIsFrom) {
  const auto expect_refused = [](const Json& scene, const std::string& expected) {
    try {
      settings(scene);
      ADD_FAILURE() << "not refused";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "s.json: /contact/stiffness: no stiffness is given, and its default, " + expected);
    }
  };
  const Json scene = sheets(R"({"thickness": 0.01})"_json);
  expect_refused(
      changed(scene, "/bodies/0/velocity", {1e200, 0, 0}),
      "inf [N/m], cannot be used: it is the greatest mass of a vertex, 3.33333 kg, over the square of the time, 1e-156 "
      "s, to cross a thickness of 0.01 m at more than 1e+154 m/s, the greatest speed at the start; expected a lower "
      "speed or mass, or a stiffness");
  expect_refused(
      changed(scene, "/scripts",
              R"([{"body": "high", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 1, "move": [0, 0, 1e153]}]}])"_json),
      "inf [N/m], cannot be used: it is the greatest mass of a vertex, 3.33333 kg, over the square of the time, 1e-155 "
      "s, to cross a thickness of 0.01 m at 1e+153 m/s, the greatest speed of a script; expected a lower speed or "
      "mass, or a stiffness");
}

TEST(SceneContact, TheEdgesOfWhatIsAllowed) {
  const Json contact = R"({"stability": 0.5, "restitution": 0, "friction": 0, "most_layers": 1,
      "layers": {"thickness_exponent": 1.25, "stiffness_exponent": 1.5, "step_exponent": 1.5}})"_json;
  EXPECT_EQ(settings(sheets(contact)).schedule, (LayerSchedule{5, 6, 6}));
}

TEST(SceneContact, WhatIsUnstableIsAcceptedOnRequest) {
  Json scene = sheets(R"({"stability": 0.75})"_json);
  scene["allow_unstable"] = true;
  EXPECT_GT(settings(scene).materials[0].step, 0);
}

TEST(SceneContact, LoosePointsNeedAThicknessThatIsSaid) {
  Json scene = loop();
  scene["bodies"][0]["pin"] = {"all"};
  scene["contact"] = Json::object();
  EXPECT_TRUE(settings<2>(scene).materials.empty()) << "nothing can move";
}

bool has(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

bool left_out(const Explanation& e, const std::string& what, const std::string& why) {
  return std::any_of(e.left_out.begin(), e.left_out.end(),
                     [&](const LeftOut& l) { return l.what == what && l.why == why; });
}

bool took(const Explanation& e, const std::string& path, const Json& value) {
  return std::find(e.defaults.begin(), e.defaults.end(), DefaultTaken{path, value}) != e.defaults.end();
}

TEST(ExplainContact, WhatItIsAndWhatIsLeftOut) {
  const Explanation e = explain(parse_scene(
      sheets(R"({"thickness": 0.05, "stiffness": 200, "pairs": [{"bodies": ["low", "floor"], "restitution": 0.25}],
                 "exclude": [["high", "high"]]})"_json)
          .dump(),
      "s.json"));
  EXPECT_TRUE(has(e.active, "contact forces"));
  EXPECT_TRUE(has(e.active, "restitution"));
  EXPECT_TRUE(left_out(e, "friction", "its coefficient is 0 everywhere"));
  EXPECT_TRUE(left_out(e, "contact of high and high", "\"exclude\" names them: they may go through each other"));
  ASSERT_EQ(e.contact.size(), 2u);
  EXPECT_EQ(e.contact[0].pairs.size(), 3u) << "low low, low high, high floor";
  EXPECT_NEAR(e.contact[0].stability, 0.05, 1e-15);
  const std::string text = to_text(e);
  EXPECT_NE(text.find("  low with floor: thickness 0.05 m (below 0.176777), stiffness 200 N/m, step 0.00228218 s "
                      "(stability 0.05), restitution 0.25 of the energy, friction 0\n"),
            std::string::npos)
      << text;
  const Json json = to_json(e);
  EXPECT_EQ(json["contact"][1]["pairs"], Json::parse(R"([["low", "floor"]])"));
  EXPECT_EQ(json["contact"][1]["stiffness"], 200);
  EXPECT_EQ(json["layers"]["step_exponent"], 1.5);
}

TEST(ExplainContact, DefaultsThatDependOnOthersAreListed) {
  const Explanation e = explain(parse_scene(changed(sheet(), "/contact", Json::object()).dump(), "s.json"));
  EXPECT_TRUE(took(e, "/contact/thickness", e.contact[0].material.thickness));
  EXPECT_TRUE(took(e, "/contact/stiffness", e.contact[0].material.stiffness));
  EXPECT_TRUE(took(e, "/contact/stability", 0.05));
  EXPECT_TRUE(took(e, "/contact/restitution", 1));
  EXPECT_TRUE(took(e, "/contact/friction", 0));
  EXPECT_TRUE(took(e, "/contact/most_layers", 1000));
  EXPECT_TRUE(left_out(e, "restitution", "it is 1 everywhere"));
}

/// The warnings about bodies that come to touch.
std::vector<std::string> of_pinches(std::vector<std::string> warnings) {
  std::erase_if(warnings, [](const std::string& w) { return w.find(" touch each other ") == w.npos; });
  return warnings;
}

/// The warnings for a ring between two walls, when the upper one moves by `move` within the first second.
std::vector<std::string> warnings_of_walls(double move, double start = 1) {
  Json scene = loop();
  scene["contact"] = Json::object();
  scene["window"] = 0.1;
  for (const double y : {-1.0, start}) {
    Json wall = scene["bodies"][0];
    wall["mesh"] = R"({"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}})"_json;
    wall["transform"]["translate"] = {0, y};
    scene["bodies"].push_back(wall);
  }
  scene["bodies"][1]["name"] = "anvil";
  scene["bodies"][1]["pin"] = {"all"};
  scene["bodies"][2]["name"] = "hammer";
  scene["scripts"] = R"([{"body": "hammer", "path": [{"t": 0, "move": [0, 0]}, {"t": 1, "move": [0.5, 0]}]}])"_json;
  scene["scripts"][0]["path"][1]["move"][1] = move;
  return explain(parse_scene(scene.dump(), "s.json")).warnings;
}

TEST(ExplainContact, WarnsOfScriptsThatPinch) {
  EXPECT_TRUE(of_pinches(warnings_of_walls(-1.9)).empty());
  const std::vector<std::string> warnings = of_pinches(warnings_of_walls(-2.5));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("anvil and hammer touch each other at about 0.8 s: ")) << warnings[0];
  EXPECT_TRUE(of_pinches(warnings_of_walls(1, -1)).empty())
      << "they touch from the start: walls that slide along others";
}

TEST(ExplainContact, WarnsOfScriptsThatPinchInSpace) {
  Json scene = sheets(Json::object());
  scene["bodies"].push_back(scene["bodies"][2]);
  scene["bodies"][3]["name"] = "press";
  scene["bodies"][3]["pin"] = Json::array();
  scene["bodies"][3]["transform"]["translate"] = {0.2, 0.3, 2};
  const auto warnings = [&scene](double move) {
    scene["scripts"] =
        R"([{"body": "press", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 0.5, "move": [0, 0, 0]}]}])"_json;
    scene["scripts"][0]["path"][1]["move"][2] = move;
    return explain(parse_scene(scene.dump(), "s.json")).warnings;
  };
  const auto pinches = [](const std::string& w) {
    return w.starts_with("floor and press touch each other at about 0.25 s: ");
  };
  const auto far = warnings(-2.9), through = warnings(-6);
  EXPECT_FALSE(std::any_of(far.begin(), far.end(), [](auto& w) { return w.find(" touch ") != w.npos; }));
  EXPECT_EQ(std::count_if(through.begin(), through.end(), pinches), 1);
}

/// Two plates of the same outline on both sides of the middle move to it and through it: every contact is degenerate.
TEST(ExplainContact, PlatesOfOneOutlinePinchWhenTheyMeet) {
  Json scene = sheets(Json::object());
  scene["bodies"].push_back(scene["bodies"][2]);
  scene["bodies"][3]["name"] = "top";
  scene["bodies"][2]["name"] = "bottom";
  scene["bodies"][0]["transform"]["translate"] = {0, 0, -3};
  for (const int plate : {2, 3}) {
    scene["bodies"][plate]["pin"] = Json::array();
    scene["bodies"][plate]["transform"]["translate"] = {0, 0, plate == 2 ? -0.125 : 0.125};
  }
  scene["scripts"] = R"([
      {"body": "top", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 1, "move": [0, 0, -0.25]}]},
      {"body": "bottom", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 1, "move": [0, 0, 0.25]}]}])"_json;
  const auto warnings = of_pinches(explain(parse_scene(scene.dump(), "s.json")).warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("bottom and top touch each other at about 0.5 s: ")) << warnings[0];
}

TEST(ExplainContact, NotesWhatIsNotCompared) {
  Json scene = sheets(Json::object());
  const std::string note =
      "cells of low and floor whose vertices are all scripted or pinned are not compared with each other: they may go "
      "through each other";
  EXPECT_FALSE(has(explain(parse_scene(scene.dump(), "s.json")).warnings, note)) << "the floor alone is pinned";
  scene["bodies"][0]["pin"] = {"left"};
  EXPECT_FALSE(has(explain(parse_scene(scene.dump(), "s.json")).warnings, note)) << "a row of vertices is no cell";
  scene["scripts"] = R"([{"body": "low", "vertices": [1, 4], "path": [{"t": 0, "move": [0, 0, 0]}]}])"_json;
  EXPECT_TRUE(has(explain(parse_scene(scene.dump(), "s.json")).warnings, note)) << "two pinned, one scripted";
  scene.erase("contact");
  EXPECT_TRUE(has(explain(parse_scene(scene.dump(), "s.json")).warnings, note)) << "that is so without contact too";
}

TEST(ExplainContact, NothingToMove) {
  Json scene = changed(sheet(), "/contact", Json::object());
  scene["bodies"][0]["pin"] = {"all"};
  const Explanation e = explain(parse_scene(scene.dump(), "s.json"));
  EXPECT_TRUE(left_out(e, "contact forces", "nothing can move, or all that can is excluded"));
  EXPECT_EQ(to_text(e).find("Contact: "), std::string::npos);
  const std::string note = "there are no layers of contact: nothing can move, or all that can is excluded";
  EXPECT_TRUE(has(e.warnings, note));
  scene["bodies"][0].erase("pin");
  EXPECT_FALSE(has(explain(parse_scene(scene.dump(), "s.json")).warnings, note));
}

}  // namespace
}  // namespace noli::integrator
