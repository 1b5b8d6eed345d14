// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/schema.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include <noli/errors.h>
#include "integrator/scene/json_text.h"

namespace noli::integrator {
namespace {

std::string parse_error(std::string_view text) {
  try {
    parse_json(text, "t.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The error in a document; "" if there is none.
std::string problem(const char* schema, const char* document) {
  try {
    validate(Json::parse(schema), Json::parse(document), "d");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ParseJson, KeepsOrderAndNumbers) {
  const Json document = parse_json(R"({"b": [1, -2, 0.1, 1e-320], "a": {"c": null, "d": [true, "\u00e9"]}})", "t.json");
  EXPECT_EQ(document.dump(), "{\"b\":[1,-2,0.1,1e-320],\"a\":{\"c\":null,\"d\":[true,\"\xc3\xa9\"]}}");
  EXPECT_EQ(parse_json("3", "t.json"), 3);
}

TEST(ParseJson, ErrorsNameLineAndColumn) {
  EXPECT_EQ(parse_error("{\"a\": 1,\n \"b\": tru }").substr(0, 53),
            "t.json: line 2, column 10: is not JSON: syntax error ");
  EXPECT_EQ(parse_error("").substr(0, 32), "t.json: line 1, column 1: is not");
  EXPECT_EQ(parse_error("[1, 2").substr(0, 26), "t.json: line 1, column 6: ");
  EXPECT_EQ(parse_error("[1]\n\n  x").substr(0, 26), "t.json: line 3, column 3: ");
  EXPECT_NE(parse_error("[NaN]"), "");
  EXPECT_NE(parse_error("[1,]"), "");
  EXPECT_NE(parse_error("[\"\xff\"]"), "");
  EXPECT_NE(parse_error("[1e999]").find("number overflow"), std::string::npos);
}

TEST(ParseJson, FieldsOccurOnce) {
  EXPECT_EQ(parse_error(R"({"a": [{"b": 1}, {"b": 1, "c": 2, "b": 3}]})"),
            "t.json: /a/1/b: expected this field once, found it twice");
  EXPECT_EQ(parse_error(R"({"a": {"b": 1}, "c": {"b": 1}})"), "");
}

TEST(ParseJson, SixtyFourLevelsAreEnough) {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_EQ(parse_error(nested(64)), "");
  EXPECT_NE(parse_error(nested(65)).find("expected at most 64 levels"), std::string::npos);
  std::string path;
  for (int i = 0; i < 64; ++i) path += "/0";
  EXPECT_NE(parse_error(std::string(65, '[')).find(path + ": expected at most 64 levels"), std::string::npos)
      << parse_error(std::string(65, '['));
  EXPECT_NE(parse_error(std::string(63, '[') + "[7,[").find(path.substr(2) + "/1: expected at most"),
            std::string::npos);
  EXPECT_NE(parse_error(nested(5000000)).find("expected at most 64 levels"), std::string::npos);
}

TEST(Nearest, Distances) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("young", "young"), 0u);
  EXPECT_EQ(edit_distance("yuong", "young"), 1u) << "neighbours exchanged";
  EXPECT_EQ(edit_distance("yung", "young"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(nearest("densty", {"thickness", "density", "damping"}), "density");
  EXPECT_EQ(nearest("x", {"a", "b"}), "a") << "the first of equals";
}

TEST(Schema, Types) {
  EXPECT_EQ(problem(R"({"type": "number"})", "1.5"), "");
  EXPECT_EQ(problem(R"({"type": "number", "unit": "Pa"})", R"("200 GPa")"),
            "d: /: expected a number [Pa], found \"200 GPa\"");
  EXPECT_EQ(problem(R"({"type": "integer"})", "5.0"), "");
  EXPECT_EQ(problem(R"({"type": "integer"})", "5.5"), "d: /: expected an integer, found 5.5");
  EXPECT_EQ(problem(R"({"type": ["integer", "string"]})", "true"), "d: /: expected an integer or a string, found true");
  EXPECT_EQ(problem(R"({"type": "boolean"})", "false"), "");
  EXPECT_EQ(problem(R"({"type": "array"})", "{}"), "d: /: expected an array, found {}");
  EXPECT_EQ(problem(R"({"type": "object"})", "[]"), "d: /: expected an object, found []");
}

TEST(Schema, Choices) {
  EXPECT_EQ(problem(R"({"const": 1})", "1"), "");
  EXPECT_EQ(problem(R"({"const": 1})", "2"), "d: /: expected 1, found 2");
  EXPECT_EQ(problem(R"({"enum": ["full", 3]})", "3"), "");
  EXPECT_EQ(problem(R"({"enum": ["full", 3]})", "\"ful\""), "d: /: expected \"full\" or 3, found \"ful\"");
}

TEST(Schema, Bounds) {
  EXPECT_EQ(problem(R"({"minimum": 0, "maximum": 1})", "0"), "");
  EXPECT_EQ(problem(R"({"minimum": 0})", "-1e-300"), "d: /: expected a number not less than 0, found -1e-300");
  EXPECT_EQ(problem(R"({"maximum": 1})", "1"), "");
  EXPECT_EQ(problem(R"({"maximum": 1})", "1.25"), "d: /: expected a number not greater than 1, found 1.25");
  EXPECT_EQ(problem(R"({"exclusiveMinimum": 0})", "1e-300"), "");
  EXPECT_EQ(problem(R"({"exclusiveMinimum": 0, "unit": "kg"})", "0"),
            "d: /: expected a number greater than 0 [kg], found 0");
  EXPECT_EQ(problem(R"({"exclusiveMaximum": 2})", "1"), "");
  EXPECT_EQ(problem(R"({"exclusiveMaximum": 2})", "2"), "d: /: expected a number less than 2, found 2");
  EXPECT_EQ(problem(R"({"minLength": 1})", "\"a\""), "");
  EXPECT_EQ(problem(R"({"minLength": 1})", "\"\""), "d: /: expected a string of at least 1 character, found \"\"");
}

TEST(Schema, Arrays) {
  const char* schema = R"({"minItems": 2, "maxItems": 3, "items": {"type": "number"}})";
  EXPECT_EQ(problem(schema, "[1, 2]"), "");
  EXPECT_EQ(problem(schema, "[1, 2, 3]"), "");
  EXPECT_EQ(problem(schema, "[1]"), "d: /: expected at least 2 items, found [1]");
  EXPECT_EQ(problem(schema, "[1, 2, 3, 4]"), "d: /: expected at most 3 items, found [1,2,3,4]");
  EXPECT_EQ(problem(schema, "[1, \"2\"]"), "d: /1: expected a number, found \"2\"");
}

TEST(Schema, Objects) {
  const char* schema = R"({"required": ["mass"], "maxProperties": 2, "additionalProperties": false, "properties":
      {"mass": {"type": "number", "unit": "kg"}, "length": {"type": "number"}, "width": {}}})";
  EXPECT_EQ(problem(schema, R"({"mass": 1})"), "");
  EXPECT_EQ(problem(schema, R"({"length": 1})"), "d: /: expected the field \"mass\" (kg)");
  EXPECT_EQ(problem(schema, R"({"mass": 1, "lenght": 2})"),
            "d: /lenght: unknown field; the nearest known one is \"length\"");
  EXPECT_EQ(problem(schema, R"({"mass": 1, "length": 2, "width": 3})"),
            "d: /: expected at most 2 fields, found [\"mass\",\"length\",\"width\"]");
  EXPECT_EQ(problem(R"({"minProperties": 1})", "{}"), "") << "an object without known fields is free of form";
  EXPECT_EQ(problem(R"({"minProperties": 1, "properties": {"a": {}}})", "{}"),
            "d: /: expected at least 1 field, found []");
  EXPECT_EQ(problem(R"({"properties": {"a~/b": {"type": "number"}}})", R"({"a~/b": ""})"),
            "d: /a~0~1b: expected a number, found \"\"");
}

TEST(Schema, Alternatives) {
  const char* schema = R"({"oneOf": [{"required": ["a"], "properties": {"a": {"type": "number"}, "x": {}}},
                                     {"required": ["b"], "properties": {"b": {"type": "number"}}}]})";
  EXPECT_EQ(problem(schema, R"({"a": 1, "x": 2})"), "");
  EXPECT_EQ(problem(schema, R"({"b": 1})"), "");
  EXPECT_EQ(problem(schema, R"({"b": "1"})"), "d: /b: expected a number, found \"1\"");
  EXPECT_EQ(problem(schema, R"({"b": 1, "x": 2})"), "d: /x: unknown field; the nearest known one is \"b\"");
  EXPECT_EQ(problem(schema, R"({"b": 1, "other": 2})"), "d: /other: unknown field; expected one of \"b\"");
  EXPECT_EQ(problem(schema, R"({"x": 2})"), "d: /: expected one of the fields \"a\", \"b\", found [\"x\"]");
  EXPECT_EQ(problem(schema, R"({"a": 1, "b": 2})"), "d: /: expected only one of the fields \"a\", \"b\"");
  EXPECT_EQ(problem(schema, "5"), "d: /: expected an object, found 5");
}

TEST(Schema, DefaultsAreFilledInAndListed) {
  const Json schema = Json::parse(R"({
      "properties": {"a": {"type": "number", "default": 3}, "b": {"type": "number", "default": 4},
                     "c": {"$ref": "#/$defs/c", "default": {}}, "e": {"type": "number"}},
      "$defs": {"c": {"properties": {"d": {"type": "array", "default": [1]}}}}})");
  const Validated validated = validate(schema, Json::parse(R"({"b": 5})"), "d");
  EXPECT_EQ(validated.document, Json::parse(R"({"b": 5, "a": 3, "c": {"d": [1]}})"));
  EXPECT_EQ(validated.defaults, (std::vector<DefaultTaken>{{"/a", 3}, {"/c/d", Json::array({1})}}));
}

TEST(Schema, WhatStandsBesideAReferenceComesFirst) {
  const char* schema =
      R"({"properties": {"a": {"$ref": "#/$defs/n", "maximum": 5}}, "$defs": {"n": {"type": "number", "maximum": 9}}})";
  EXPECT_EQ(problem(schema, R"({"a": 5})"), "");
  EXPECT_EQ(problem(schema, R"({"a": 6})"), "d: /a: expected a number not greater than 5, found 6");
}

TEST(Schema, UnknownKeywordsAreAFaultOfTheSchema) {
  EXPECT_THROW(problem(R"({"pattern": "a"})", "\"a\""), std::logic_error);
  EXPECT_THROW(problem(R"({"type": "decimal"})", "1"), std::logic_error);
}

/// Calls `visit` for a schema and for each schema within it.
void visit_schemas(const Json& schema, const std::function<void(const Json&)>& visit) {
  visit(schema);
  for (const char* group : {"properties", "$defs"}) {
    if (!schema.contains(group)) continue;
    for (const auto& item : schema[group].items()) visit_schemas(item.value(), visit);
  }
  if (schema.contains("items")) visit_schemas(schema["items"], visit);
  if (!schema.contains("oneOf")) return;
  for (const Json& alternative : schema["oneOf"]) visit_schemas(alternative, visit);
}

TEST(Schema, TheShippedOneKeepsToTheSubset) {
  const Json shipped = Json::parse(scene_schema_text());
  std::size_t objects = 0;
  visit_schemas(shipped, [&](const Json& schema) {
    Json alone = schema;  // its parts are visited separately
    for (const char* part : {"properties", "$defs", "items", "oneOf", "$ref", "required"}) alone.erase(part);
    try {
      validate(alone, "no schema says this", "d");
    } catch (const InputError&) {  // expected
    }
    if (schema.contains("properties")) {
      ++objects;
      EXPECT_EQ(schema.value("additionalProperties", Json()), false)
          << schema.value("description", "") << schema["properties"];
    }
    for (const auto& name : schema.value("required", std::vector<std::string>{})) {
      EXPECT_TRUE(schema["properties"].contains(name)) << name;
      EXPECT_FALSE(schema["properties"][name].contains("default")) << name << " is required and has a default";
    }
    if (schema.contains("$ref")) {
      EXPECT_TRUE(shipped.contains(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)))) << schema["$ref"];
    }
  });
  EXPECT_GT(objects, 15u);
}

}  // namespace
}  // namespace noli::integrator
