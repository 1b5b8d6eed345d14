// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/read_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <ostream>
#include <set>

#include <noli/errors.h>
#include "integrator/scene/explain.h"
#include "tests/integrator/scenes.h"

namespace noli::integrator {
namespace {

using testing::changed;
using testing::problem_of;
using testing::sheet;
using testing::without;

TEST(ReadScene, TheLeastSceneTakesDefaults) {
  const Scene scene = parse_scene(sheet().dump(), "s.json");
  EXPECT_EQ(scene.dimension, 3);
  EXPECT_EQ(scene.duration, 1);
  EXPECT_EQ(scene.window, 0.01);
  EXPECT_EQ(scene.seed, 1u);
  EXPECT_EQ(scene.record, Record::full);
  EXPECT_EQ(scene.frame_rate, 60);
  EXPECT_EQ(scene.steps, Clocks::grouped);
  EXPECT_EQ(scene.step_factor, 0.5);
  EXPECT_FALSE(scene.allow_unstable);
  EXPECT_EQ(scene.gravity, (Position{0, 0, 0}));
  EXPECT_FALSE(scene.gravity_step);
  ASSERT_EQ(scene.bodies.size(), 1u);
  const Body& body = scene.bodies[0];
  EXPECT_EQ(body.name, "body0");
  EXPECT_EQ(std::get<Grid>(body.mesh), (Grid{{1, 1}, {2, 2}, Diagonals::alternating, {}}));
  EXPECT_EQ(body.deform, Deform{});
  EXPECT_EQ(body.transform, Transform{});
  EXPECT_EQ(std::get<ElasticMaterial>(body.material.kind), (ElasticMaterial{1e5, 0.3, 1000, 0.01, 0.01, 1}));
  EXPECT_TRUE(body.stretch && body.bend);
  EXPECT_TRUE(body.pin.empty());
  EXPECT_EQ(scene.defaults.front(), (DefaultTaken{"/title", ""}));
}

TEST(ReadScene, DefaultVectorsOfThePlaneHaveTwoNumbers) {
  const Scene scene = parse_scene(testing::loop().dump(), "s.json");
  EXPECT_EQ(scene.document["gravity"], Json::array({0, 0}));
  EXPECT_EQ(scene.document["bodies"][0]["transform"]["translate"], Json::array({0, 0}));
  for (const DefaultTaken& taken : scene.defaults) {
    if (taken.value.is_array()) {
      EXPECT_NE(taken.value.size(), 3u) << taken.path;
    }
  }
}

struct Bad {
  const char* pointer;  ///< where the scene is changed; "-..." to remove the field
  const char* value;
  const char* message;
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.pointer << " = " << bad.value; }

class BadScene : public ::testing::TestWithParam<Bad> {};

TEST_P(BadScene, IsAnsweredWithThePathAndWhatWasExpected) {
  const auto& [pointer, value, message] = GetParam();
  const Json scene = *pointer == '-' ? without(sheet(), pointer + 1) : changed(sheet(), pointer, Json::parse(value));
  EXPECT_EQ(problem_of(scene), std::string("s.json: ") + message);
}

INSTANTIATE_TEST_SUITE_P(
    Fields, BadScene,
    ::testing::Values(
        Bad{"/noli_scene", "2", "/noli_scene: expected 1, found 2"},
        Bad{"-/noli_scene", "", "/: expected the field \"noli_scene\" (version of this format)"},
        Bad{"-/bodies/0/material/density", "", "/bodies/0/material: expected the field \"density\" (kg/m^3)"},
        Bad{"-/bodies/0/mesh", "", "/bodies/0: expected the field \"mesh\" (a generator or a file)"},
        Bad{"/bodies", "[]", "/bodies: expected at least 1 item, found []"},
        Bad{"/gravitiy", "[0,0,1]", "/gravitiy: unknown field; the nearest known one is \"gravity\""},
        Bad{"/bodies/0/material/densty", "1",
            "/bodies/0/material/densty: unknown field; the nearest known one is \"density\""},
        Bad{"/bodies/0/friction", "0.3", "/bodies/0/friction: unknown field here; it belongs to \"contact\""},
        Bad{"/bodies/0/damping", "1", "/bodies/0/damping: unknown field here; it belongs to \"material\""},
        Bad{"/bodies/0/gravity", "[0,0,1]", "/bodies/0/gravity: unknown field here; it belongs to the scene"},
        Bad{"/bodies/0/mesh/gird", "{}", "/bodies/0/mesh/gird: unknown field; the nearest known one is \"grid\""},
        Bad{"/bodies/0/mesh/grid/cell", "1",
            "/bodies/0/mesh/grid/cell: unknown field; the nearest known one is \"cells\""},
        Bad{"/bodies/0/mesh/disc", R"({"radius": 1, "rings": 2})",
            "/bodies/0/mesh: expected at most 1 field, found [\"grid\",\"disc\"]"},
        Bad{"/bodies/0/material/density", "-1",
            "/bodies/0/material/density: expected a number greater than 0 [kg/m^3], found -1"},
        Bad{"/bodies/0/material/density", "\"1 g/cm^3\"",
            "/bodies/0/material/density: expected a number [kg/m^3], found \"1 g/cm^3\""},
        Bad{"/bodies/0/material/thickness", "0",
            "/bodies/0/material/thickness: expected a number greater than 0 [m], found 0"},
        Bad{"/bodies/0/material/young", "null", "/bodies/0/material/young: expected a number [Pa], found null"},
        Bad{"/bodies/0/material/poisson", "0.6",
            "/bodies/0/material/poisson: expected a number not greater than 0.5, found 0.6"},
        Bad{"/bodies/0/material/damping", "-0.1",
            "/bodies/0/material/damping: expected a number not less than 0 [s], found -0.1"},
        Bad{"/bodies/0/material/edge_stiffness", "5",
            "/bodies/0/material: expected only one of the fields \"young\", \"edge_stiffness\""},
        Bad{"/bodies/0/material", "{\"density\": 5}",
            "/bodies/0/material: expected one of the fields \"young\", \"edge_stiffness\", found [\"density\"]"},
        Bad{"/bodies/0/material", "{\"edge_stiffness\": 5}",
            "/bodies/0/material: expected exactly one of the fields \"mass_per_area\", \"mass_per_length\", "
            "\"mass_per_vertex\", found none"},
        Bad{"/bodies/0/material", R"({"edge_stiffness": 5, "mass_per_area": 1, "mass_per_vertex": 1})",
            "/bodies/0/material: expected exactly one of the fields \"mass_per_area\", \"mass_per_length\", "
            "\"mass_per_vertex\", found \"mass_per_area\" and \"mass_per_vertex\""},
        Bad{"/bodies/0/material", R"({"edge_stiffness": 5, "mass_per_area": 1, "density": 1})",
            "/bodies/0/material/density: cannot be combined with \"edge_stiffness\""},
        Bad{"/bodies/0/material/mass_per_area", "1",
            "/bodies/0/material/mass_per_area: cannot be combined with \"young\""},
        Bad{"/bodies/0/material", R"({"edge_stiffness": 5, "mass_per_vertex": -1})",
            "/bodies/0/material/mass_per_vertex: expected a number greater than 0 [kg], found -1"},
        Bad{"/window", "0", "/window: expected a number greater than 0 [s], found 0"},
        Bad{"/window", "1e-300",
            "/window: expected more than 8.881784197001252e-16 [s], 2^-50 of the duration, found 1e-300: shorter times "
            "cannot be counted"},
        Bad{"/bodies/0/steps", "{\"bend\": 1e-20}",
            "/bodies/0/steps/bend: expected more than 8.881784197001252e-16 [s], 2^-50 of the duration, found 1e-20: "
            "shorter times cannot be counted"},
        Bad{"/duration", "-1", "/duration: expected a number greater than 0 [s], found -1"},
        Bad{"/dimension", "4", "/dimension: expected 2 or 3, found 4"},
        Bad{"/record", "\"none\"", "/record: expected \"full\" or \"frames\", found \"none\""},
        Bad{"/seed", "1.5", "/seed: expected an integer, found 1.5"},
        Bad{"/step_factor", "0", "/step_factor: expected a number greater than 0, found 0"},
        Bad{"/step_factor", "1.5",
            "/step_factor: expected at most 1, which is the limit of stability, or \"allow_unstable\": true, found "
            "1.5"},
        Bad{"/bodies/0/steps", "{\"stretch\": -1e-3}",
            "/bodies/0/steps/stretch: expected a number greater than 0 [s], found -0.001"},
        Bad{"/bodies/0/steps", "{\"bend\": 0.02}",
            "/bodies/0/steps/bend: expected at most the window, 0.01 [s], found 0.02"},
        Bad{"/gravity_step", "1", "/gravity_step: expected at most the window, 0.01 [s], found 1"},
        Bad{"/gravity", "[0, -9.81]",
            "/gravity: expected 3 numbers, as many as the scene has dimensions, found [0,-9.81]"},
        Bad{"/gravity", "[0, 0, \"9.81\"]", "/gravity/2: expected a number, found \"9.81\""},
        Bad{"/bodies/0/mesh/grid/cells", "[0, 4]",
            "/bodies/0/mesh/grid/cells/0: expected a number not less than 1, found 0"},
        Bad{"/bodies/0/mesh/grid/cells", "[10000000, 10000000]",
            "/bodies/0/mesh/grid/cells: expected at most 20000000 vertices, found 100000020000001"},
        Bad{"/bodies/0/mesh", R"({"chain": {"points": [[0,0,0],[1,0,0]], "segments": 2, "closed": true}})",
            "/bodies/0/mesh/chain/segments: expected at least 3, as the chain is closed, found 2"},
        Bad{"/bodies/0/mesh", R"({"torus": {"radius": 1, "tube_radius": 1, "segments": 3, "sides": 3}})",
            "/bodies/0/mesh/torus/tube_radius: expected less than the radius, 1 [m], found 1"},
        Bad{"/bodies/0/pin", "[-1]", "/bodies/0/pin/0: expected a number not less than 0, found -1"},
        Bad{"/bodies/0/pin", "[true]", "/bodies/0/pin/0: expected an integer or a string or an object, found true"},
        Bad{"/bodies/0/pin", "[{\"box\": [[1,0,0],[0,1,1]]}]",
            "/bodies/0/pin/0/box: expected the lowest corner, then the highest, found [[1,0,0],[0,1,1]]"},
        Bad{"/bodies/0/deform", "{\"stretch\": [1, 0, 1]}",
            "/bodies/0/deform/stretch: expected factors greater than 0, found [1,0,1]"},
        Bad{"/bodies/0/transform", "{\"scale\": 0}",
            "/bodies/0/transform/scale: expected a number greater than 0, found 0"},
        Bad{"/bodies/0/transform", "{\"rotate\": {\"degrees\": 5}}",
            "/bodies/0/transform/rotate: expected both fields \"axis\" and \"degrees\""},
        Bad{"/bodies/0/transform", "{\"rotate\": {\"degrees\": 5, \"quaternion\": [1, 0, 0, 0]}}",
            "/bodies/0/transform/rotate: expected either \"quaternion\" or \"axis\" and \"degrees\""},
        Bad{"/bodies/0/transform", "{\"rotate\": {\"quaternion\": [0, 0, 0, 0]}}",
            "/bodies/0/transform/rotate/quaternion: expected a quaternion that is not zero"},
        Bad{"/bodies/0/transform", "{\"rotate\": {\"axis\": [0, 0, 0], \"degrees\": 3}}",
            "/bodies/0/transform/rotate/axis: expected a vector that is not zero"},
        Bad{"/bodies/0/spin", "3", "/bodies/0/spin: expected 3 numbers, as the scene has dimension 3, found 3"},
        Bad{"/bodies/0/patches", "[{\"stiffness_factor\": 2}]",
            "/bodies/0/patches/0: expected the field \"box\" (everything in it at the start, including its faces: "
            "lowest corner, highest corner)"},
        Bad{"/scripts", "[{\"body\": \"bdy0\", \"path\": [{\"t\": 0, \"move\": [0,0,0]}]}]",
            "/scripts/0/body: no body has the name \"bdy0\"; the nearest is \"body0\""},
        Bad{"/scripts", "[{\"body\": \"body0\"}]",
            "/scripts/0: expected exactly one of the fields \"path\", \"frames\", found none"},
        Bad{"/scripts",
            R"([{"body": "body0", "path": [{"t": 0, "move": [0,0,0]}], "frames": {"files": ["a.ply"], "rate": 1}}])",
            "/scripts/0: expected exactly one of the fields \"path\", \"frames\", found \"path\" and \"frames\""},
        Bad{"/scripts", R"([{"body": "body0", "path": [{"t": 1, "move": [0,0,0]}, {"t": 1, "move": [0,0,1]}]}])",
            "/scripts/0/path/1/t: expected a time after the one before it, 1 [s], found 1"},
        Bad{"/scripts", R"([{"body": "body0", "path": [{"t": -1, "move": [0,0,0]}]}])",
            "/scripts/0/path/0/t: expected a number not less than 0 [s], found -1"}));

TEST(ReadScene, WhatIsNoJsonIsNamedByLineAndColumn) {
  try {
    parse_scene("{\n  \"noli_scene\": 1,\n  \"duration\": 1.2.3\n}", "s.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 46), "s.json: line 3, column 18: is not JSON: syntax");
  }
  EXPECT_EQ(problem_of("[]"_json), "s.json: /: expected an object, found []");
}

TEST(ReadScene, AResultIsNoScene) {
  try {
    parse_scene(R"({"schema": "noli-verify", "version": 1})", "result.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("result.json: is a result (noli-verify); expected a scene"),
              std::string::npos)
        << error.what();
  }
}

TEST(ReadScene, AFileThatIsNotThere) { EXPECT_THROW(read_scene("no/such/scene.json"), InputError); }

TEST(ReadScene, NamesOfBodiesDiffer) {
  Json scene = sheet();
  scene["bodies"].push_back(scene["bodies"][0]);
  EXPECT_EQ(problem_of(scene), "");
  scene["bodies"][1]["name"] = "body0";
  EXPECT_EQ(problem_of(scene), "s.json: /bodies/1/name: expected another name than that of body 0, \"body0\"");
}

TEST(ReadScene, StepsAboveTheLimitAreAcceptedOnRequest) {
  Json scene = changed(sheet(), "/step_factor", 1.5);
  scene["allow_unstable"] = true;
  EXPECT_EQ(problem_of(scene), "");
}

TEST(ReadScene, ThePlaneHasCurvesAndDegreesOnly) {
  const Json loop = testing::loop();
  EXPECT_EQ(problem_of(loop), "");
  EXPECT_EQ(
      problem_of(changed(loop, "/bodies/0/mesh", R"({"grid": {"size": [1, 1], "cells": [1, 1]}})"_json)),
      "s.json: /bodies/0/mesh/grid: expected \"points\", \"chain\", \"ring\" or \"file\" in a scene of dimension 2");
  EXPECT_EQ(problem_of(changed(loop, "/bodies/0/spin", "[0, 0, 1]"_json)),
            "s.json: /bodies/0/spin: expected one number, as the scene has dimension 2, found [0,0,1]");
  EXPECT_EQ(problem_of(changed(loop, "/bodies/0/deform/twist", 1)),
            "s.json: /bodies/0/deform/twist: expected 0 in a scene of dimension 2");
  const auto rotated = [&](const char* rotate) {
    return changed(loop, "/bodies/0/transform/rotate", Json::parse(rotate));
  };
  EXPECT_EQ(problem_of(rotated(R"({"degrees": 30})")), "");
  EXPECT_EQ(problem_of(rotated(R"({"axis": [0, 1]})")),
            "s.json: /bodies/0/transform/rotate: expected the field \"degrees\", as the scene has dimension 2");
  EXPECT_EQ(problem_of(rotated(R"({"degrees": 30, "axis": [0, 1]})")),
            "s.json: /bodies/0/transform/rotate/axis: expected only \"degrees\", as the scene has dimension 2");
}

TEST(ShortForm, PutsItsValuesInPlace) {
  Json scene = sheet();
  scene["short"] = R"({"/duration": 0.25, "/bodies/0/mesh/grid/cells": [1, 1], "/bodies/0/name": "cloth"})"_json;
  const Scene full = parse_scene(scene.dump(), "s.json"), brief = parse_scene(scene.dump(), "s.json", Form::brief);
  EXPECT_EQ(full.duration, 1);
  EXPECT_EQ(std::get<Grid>(full.bodies[0].mesh).cells[0], 2u);
  EXPECT_EQ(brief.duration, 0.25);
  EXPECT_EQ(std::get<Grid>(brief.bodies[0].mesh).cells[0], 1u);
  EXPECT_EQ(brief.bodies[0].name, "cloth");
}

/// The error of both forms when the short form sets this place to 1.
std::string problem_of_short(const std::string& place) {
  Json scene = sheet();
  scene["short"] = {{place, 1}};
  const std::string problem = problem_of(scene);
  EXPECT_EQ(problem_of(scene, Form::brief), problem);
  return problem;
}

TEST(ShortForm, PlacesMustBeThereEvenIfNobodyAsksForIt) {
  for (const auto& [place, what] : std::map<std::string, std::string>{
           {"/bodies/1", "/bodies has 1 item, counted from 0"},
           {"/bodies/7/name", "/bodies has 1 item, counted from 0"},
           {"/bodies/99999999999999999999", "/bodies has 1 item, counted from 0"},
           {"/bodies/-", "/bodies has 1 item, counted from 0"},
           {"/bodies/00/mesh", "/bodies has 1 item, counted from 0"},
           {"/bodies/0/mesh/grid/cells/2", "/bodies/0/mesh/grid/cells has 2 items, counted from 0"},
           {"/no/such", "there is no /no"},
           {"/bodie/0/name", "there is no /bodie; the nearest is /bodies"},
           {"/bodies/0/mehs/grid", "there is no /bodies/0/mehs; the nearest is /bodies/0/mesh"},
           {"/duration/0", "/duration is neither an object nor an array"}}) {
    EXPECT_EQ(problem_of_short(place), "s.json: /short: \"" + place + "\" is not a place in this file: " + what);
  }
  for (const std::string text : {"duration", "", "/~2"}) {
    EXPECT_EQ(problem_of_short(text),
              "s.json: /short: expected a JSON pointer to a place in this file, such as \"/duration\" or "
              "\"/bodies/0/mesh\", found \"" +
                  text + "\"");
  }
}

TEST(ShortForm, ItsValuesAreCheckedEvenIfNobodyAsksForIt) {
  EXPECT_EQ(problem_of_short("/duratoin"),
            "s.json: /short: /duratoin: unknown field; the nearest known one is \"duration\"");
  EXPECT_EQ(problem_of_short("/bodies/0/name"), "s.json: /short: /bodies/0/name: expected a string, found 1");
  EXPECT_EQ(problem_of_short("/gravity_step"),
            "s.json: /short: /gravity_step: expected at most the window, 0.01 [s], found 1");
  Json scene = changed(sheet(), "/short", 5);
  EXPECT_EQ(problem_of(scene), "s.json: /short: expected an object, found 5");
  EXPECT_EQ(problem_of(scene, Form::brief), "s.json: /short: expected an object, found 5");
}

TEST(ShortForm, ErrorsOfTheFullFormAreNotThoseOfTheShortForm) {
  Json scene = changed(sheet(), "/duration", -1);
  scene["short"] = {{"/duration", 1}};
  for (const Form form : {Form::full, Form::brief}) {
    EXPECT_EQ(problem_of(scene, form), "s.json: /duration: expected a number greater than 0 [s], found -1");
  }
}

/// Calls visit(pointer, value) for all values that are neither objects nor arrays.
void visit_leaves(const Json& value, const Json::json_pointer& at,
                  const std::function<void(const Json::json_pointer&, const Json&)>& visit) {
  if (value.is_object()) {
    for (const auto& item : value.items()) visit_leaves(item.value(), at / item.key(), visit);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) visit_leaves(value[i], at / i, visit);
  } else {
    visit(at, value);
  }
}

/// A different valid value for the same field.
Json other(const Json& value) {
  static const std::map<std::string, std::string> twins = {
      {"frames", "full"}, {"own", "grouped"}, {"parallel", "alternating"}, {"stretch", "bend"},
      {"left", "right"},  {"body0", "curve"}, {"body2", "body3"}};
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_number_integer()) return value.get<int>() + 1;
  if (value.is_number()) return value.get<double>() * 0.75;
  const auto text = value.get<std::string>();
  return twins.contains(text) ? twins.at(text) : text + "x";
}

TEST(ReadScene, OddValuesAreReadOrRefused) {
  std::vector<Json> odd = {nullptr, true, -1, 0, 1e300, 1e-300, 0.5, "", "x", Json::array(), Json::object()};
  std::size_t read = 0, refused = 0;
  for (Json scene : {sheet(), testing::loop(), testing::scripted()}) {
    visit_leaves(scene, Json::json_pointer(), [&](const Json::json_pointer& at, const Json&) {
      for (const Json& value : odd) {
        Json edited = scene;
        edited[at] = value;
        try {
          explain(parse_scene(edited.dump(), "s.json"));
          ++read;
        } catch (const InputError& error) {  // any other exception ends the test
          EXPECT_EQ(std::string(error.what()).substr(0, 9), "s.json: /") << error.what();
          ++refused;
        }
      }
    });
  }
  EXPECT_GT(read, 50u);
  EXPECT_GT(refused, 500u);
}

TEST(ReadScene, EveryFieldCounts) {
  for (const Json& scene : testing::scenes_with_every_field()) {
    const Scene original = parse_scene(scene.dump(), "s.json");
    visit_leaves(scene, Json::json_pointer(), [&](const Json::json_pointer& at, const Json& value) {
      const std::string place = at.to_string();
      if (place == "/noli_scene" || place == "/dimension" || place.starts_with("/short")) return;
      Json edited = scene;
      edited[at] = other(value);
      Scene read = parse_scene(edited.dump(), "s.json");
      EXPECT_FALSE(testing::same(read, original)) << place << " is not read: " << edited[at];
    });
  }
}

/// Collects fields as "grid.cells" (definition and field): all fields of the schema, and those used in a document.
class Fields {
 public:
  void all(const Json& schema, const std::string& name) {
    const Json properties = schema.value("properties", Json::object());
    for (const auto& item : properties.items()) {
      found.insert(name + "." + item.key());
      all(item.value(), name + "." + item.key());
    }
    if (schema.contains("items")) all(schema["items"], name);
  }
  void of(const Json& value, const Json& schema, const std::string& name) {
    if (schema.contains("$ref")) {
      const auto target = schema["$ref"].get<std::string>();
      return of(value, root_.at(Json::json_pointer(target.substr(1))), target.substr(target.rfind('/') + 1));
    }
    if (schema.contains("oneOf")) return of(value, schema["oneOf"][value.contains("young") ? 0 : 1], name);
    if (value.is_array() && schema.contains("items")) {
      for (const Json& item : value) of(item, schema["items"], name);
    }
    if (!value.is_object() || !schema.contains("properties")) return;
    for (const auto& item : value.items()) {
      found.insert(name + "." + item.key());
      of(item.value(), schema["properties"][item.key()], name + "." + item.key());
    }
  }
  std::set<std::string> found;

 private:
  const Json root_ = Json::parse(scene_schema_text());
};

TEST(ReadScene, AFinePlaceIsInTheGridAndOfAFewVertices) {
  const auto with = [](const char* refine) {
    return changed(sheet(), "/bodies/0/mesh/grid/refine", Json::parse(refine));
  };
  const Scene scene = parse_scene(with(R"({"at": [0.25, -0.5], "factor": 7})").dump(), "s.json");
  EXPECT_EQ(std::get<Grid>(scene.bodies[0].mesh).refine, (FinePlace{{0.25, -0.5}, 7, 0}));
  const auto expect_refused = [&](const char* refine, const char* where) {
    EXPECT_NE(problem_of(with(refine)).find(where), std::string::npos) << problem_of(with(refine));
  };
  expect_refused(R"({"at": [0.25, -0.6], "factor": 7})", "/bodies/0/mesh/grid/refine/at/1");
  expect_refused(R"({"at": [0, 0], "factor": 1})", "/bodies/0/mesh/grid/refine/factor");
  expect_refused(R"({"at": [0, 0], "factor": 1e6, "radius": 1})", "/bodies/0/mesh/grid/refine");
  expect_refused(R"({"at": [0, 0]})", "/bodies/0/mesh/grid/refine");
}

TEST(ReadScene, TheScenesWithEveryFieldHaveEveryField) {
  const Json schema = Json::parse(scene_schema_text());
  Fields known, used;
  known.all(schema, "");
  for (const auto& definition : schema["$defs"].items()) known.all(definition.value(), definition.key());
  for (const Json& scene : testing::scenes_with_every_field()) used.of(scene, schema, "");
  EXPECT_GT(known.found.size(), 80u);
  EXPECT_EQ(known.found, used.found);
}

}  // namespace
}  // namespace noli::integrator
