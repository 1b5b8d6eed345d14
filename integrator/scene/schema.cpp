// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include <noli/errors.h>
#include "integrator/scene/json_text.h"

namespace noli::integrator {
namespace {

constexpr std::array<std::string_view, 25> keywords = {"$ref",
                                                       "type",
                                                       "const",
                                                       "enum",
                                                       "minimum",
                                                       "maximum",
                                                       "exclusiveMinimum",
                                                       "exclusiveMaximum",
                                                       "minLength",
                                                       "items",
                                                       "minItems",
                                                       "maxItems",
                                                       "properties",
                                                       "required",
                                                       "additionalProperties",
                                                       "minProperties",
                                                       "maxProperties",
                                                       "default",
                                                       "oneOf",
                                                       "$schema",
                                                       "$id",
                                                       "$defs",
                                                       "title",
                                                       "description",
                                                       "unit"};

void require_known_keywords(const Json& schema) {
  for (const auto& [keyword, value] : schema.items()) {
    if (std::find(keywords.begin(), keywords.end(), keyword) == keywords.end()) {
      throw std::logic_error("scene schema: unknown keyword " + keyword);
    }
  }
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

bool has_type(const Json& value, std::string_view type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer") {
    return value.is_number_integer() || (value.is_number_float() && std::trunc(value.get<double>()) == value);
  }
  throw std::logic_error(fmt::format("scene schema: unknown type {}", type));
}

std::string with_article(std::string_view type) {
  const bool vowel = type == "object" || type == "array" || type == "integer";
  return fmt::format("{} {}", vowel ? "an" : "a", type);
}

std::vector<std::string> types(const Json& schema) {
  if (!schema.contains("type")) return {};
  if (schema["type"].is_array()) return schema["type"].get<std::vector<std::string>>();
  return {schema["type"].get<std::string>()};
}

/// "1 field", "3 fields".
std::string counted(const Json& n, std::string_view noun) {
  return fmt::format("{} {}{}", n.dump(), noun, n == 1 ? "" : "s");
}

class Validator {
 public:
  Validator(const Json& root, const std::string& file) : root_(root), file_(file) {}

  void check(const Json& unresolved, Json& value, const Json::json_pointer& at) {
    const Json& schema = resolved(unresolved);
    require_known_keywords(schema);
    if (schema.contains("oneOf")) return check(alternative(schema["oneOf"], value, at), value, at);
    check_type(schema, value, at);
    check_choice(schema, value, at);
    if (value.is_number()) check_number(schema, value, at);
    if (value.is_string()) check_string(schema, value, at);
    if (value.is_array()) check_array(schema, value, at);
    if (value.is_object()) check_object(schema, value, at);
  }

  std::vector<DefaultTaken> defaults;

 private:
  [[noreturn]] void fail(const Json::json_pointer& at, const std::string& problem) const {
    const std::string path = at.to_string();
    throw InputError(file_, path.empty() ? "/" : path, problem);
  }
  [[noreturn]] void expected(const Json& schema, const Json& value, const Json::json_pointer& at,
                             const std::string& what) const {
    const std::string unit = schema.contains("unit") ? fmt::format(" [{}]", schema["unit"].get<std::string>()) : "";
    fail(at, fmt::format("expected {}{}, found {}", what, unit, brief(value)));
  }

  /// The schema merged with the target of its $ref; members next to the $ref take precedence. Each place of the schema
  /// is merged once. Precondition: `schema` lives as long as the root, of which it is a part, or as what is merged.
  const Json& resolved(const Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    const auto known = merged_.find(&schema);
    if (known != merged_.end()) return known->second;
    Json merged = resolved(root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1))));
    for (const auto& [keyword, value] : schema.items()) {
      if (keyword != "$ref") merged[keyword] = value;
    }
    return merged_.emplace(&schema, std::move(merged)).first->second;
  }

  void check_type(const Json& schema, const Json& value, const Json::json_pointer& at) const {
    const std::vector<std::string> allowed = types(schema);
    if (allowed.empty() || std::any_of(allowed.begin(), allowed.end(), [&](auto& t) { return has_type(value, t); })) {
      return;
    }
    std::string list;
    for (const std::string& type : allowed) list += (list.empty() ? "" : " or ") + with_article(type);
    expected(schema, value, at, list);
  }

  void check_choice(const Json& schema, const Json& value, const Json::json_pointer& at) const {
    if (schema.contains("const") && value != schema["const"]) expected(schema, value, at, schema["const"].dump());
    if (!schema.contains("enum")) return;
    const Json& choices = schema["enum"];
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
    std::string list;
    for (const Json& choice : choices) list += (list.empty() ? "" : " or ") + choice.dump();
    expected(schema, value, at, list);
  }

  void check_number(const Json& schema, const Json& value, const Json::json_pointer& at) const {
    const auto bound = [&](const char* keyword, const char* relation, auto holds) {
      if (!schema.contains(keyword) || holds(value.get<double>(), schema[keyword].get<double>())) return;
      expected(schema, value, at, fmt::format("a number {} {}", relation, schema[keyword].dump()));
    };
    bound("minimum", "not less than", [](double x, double limit) { return x >= limit; });
    bound("maximum", "not greater than", [](double x, double limit) { return x <= limit; });
    bound("exclusiveMinimum", "greater than", [](double x, double limit) { return x > limit; });
    bound("exclusiveMaximum", "less than", [](double x, double limit) { return x < limit; });
  }

  void check_string(const Json& schema, const Json& value, const Json::json_pointer& at) const {
    if (schema.contains("minLength") && value.get_ref<const std::string&>().size() < schema["minLength"]) {
      expected(schema, value, at, "a string of at least " + counted(schema["minLength"], "character"));
    }
  }

  void check_array(const Json& schema, Json& value, const Json::json_pointer& at) {
    check_size(schema, value, at, "minItems", "maxItems", "item");
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < value.size(); ++i) check(schema["items"], value[i], at / i);
  }

  void check_size(const Json& schema, const Json& value, const Json::json_pointer& at, const char* least,
                  const char* most, const char* noun) const {
    const Json found = value.is_object() ? Json(keys(value)) : value;
    if (schema.contains(least) && value.size() < schema[least]) {
      expected(schema, found, at, "at least " + counted(schema[least], noun));
    }
    if (schema.contains(most) && value.size() > schema[most]) {
      expected(schema, found, at, "at most " + counted(schema[most], noun));
    }
  }

  void check_object(const Json& schema, Json& value, const Json::json_pointer& at) {
    if (!schema.contains("properties")) return;  // any members are allowed
    const Json& properties = schema["properties"];
    for (const auto& item : value.items()) {
      if (!properties.contains(item.key())) fail_unknown(schema, item.key(), at);
    }
    for (const auto& name : schema.value("required", std::vector<std::string>{})) {
      if (!value.contains(name))
        fail(at, fmt::format("expected the field {}", Json(name).dump()) + meaning(properties[name]));
    }
    check_size(schema, value, at, "minProperties", "maxProperties", "field");
    for (const auto& [name, property] : properties.items()) check_field(name, property, value, at);
  }

  void check_field(const std::string& name, const Json& property, Json& object, const Json::json_pointer& at) {
    const Json& schema = resolved(property);
    const bool taken = !object.contains(name) && schema.contains("default");
    if (taken) object[name] = schema["default"];
    if (taken && !object[name].is_object()) defaults.push_back({(at / name).to_string(), object[name]});
    if (object.contains(name)) check(property, object[name], at / name);
  }

  /// `schema`: of the object at this place; if it is an alternative, the first field that it requires decided so.
  [[noreturn]] void fail_unknown(const Json& schema, const std::string& name, const Json::json_pointer& at) const {
    const std::vector<std::string> known = keys(schema["properties"]);
    if (const auto near = nearest(name, known)) {
      fail(at / name, fmt::format("unknown field; the nearest known one is {}", Json(*near).dump()));
    }
    const std::string owner = owner_of(root_, "the scene", name, 0);
    if (!at.empty() && owner == Json(at.back()).dump()) {
      const bool decided = schema.contains("required");
      fail(at / name,
           "cannot be combined with " + (decided ? schema["required"][0].dump() : "the other fields of " + owner));
    }
    if (!owner.empty()) fail(at / name, fmt::format("unknown field here; it belongs to {}", owner));
    fail(at / name, "unknown field; " + nearest_or_all(name, known));
  }

  /// Of which object a field with this name is; empty: of none. `owner`: what the schema describes.
  std::string owner_of(const Json& schema, const std::string& owner, const std::string& name, int depth) const {
    constexpr int most_levels = 8;  // a schema may refer to itself
    if (depth > most_levels) return "";
    const Json& here = resolved(schema);
    if (here.contains("properties") && here["properties"].contains(name)) return owner;
    std::string found;
    const auto look = [&](const Json& inner, const std::string& inner_owner) {
      if (found.empty()) found = owner_of(inner, inner_owner, name, depth + 1);
    };
    if (here.contains("oneOf")) {
      for (const Json& alternative : here["oneOf"]) look(alternative, owner);
    }
    if (here.contains("properties")) {
      for (const auto& [key, property] : here["properties"].items()) look(property, Json(key).dump());
    }
    if (here.contains("items")) look(here["items"], owner);
    return found;
  }

  /// The meaning of a missing field, for messages: " (of each edge)", " (kg/m^3)".
  std::string meaning(const Json& property) const {
    const Json& schema = resolved(property);
    for (const char* keyword : {"description", "unit"}) {
      if (schema.contains(keyword)) return fmt::format(" ({})", schema[keyword].get<std::string>());
    }
    return "";
  }

  /// The alternative whose first required field the object has.
  const Json& alternative(const Json& alternatives, const Json& value, const Json::json_pointer& at) const {
    if (!value.is_object()) expected(alternatives, value, at, "an object");
    const Json* found = nullptr;
    std::vector<std::string> signs;
    for (const Json& candidate : alternatives) {
      signs.push_back(resolved(candidate)["required"][0].get<std::string>());
      if (!value.contains(signs.back())) continue;
      if (found != nullptr) fail(at, fmt::format("expected only one of the fields \"{}\"", fmt::join(signs, "\", \"")));
      found = &candidate;
    }
    if (found == nullptr) {
      fail(at, fmt::format("expected one of the fields \"{}\", found {}", fmt::join(signs, "\", \""),
                           brief(Json(keys(value)))));
    }
    return *found;
  }

  const Json& root_;
  const std::string& file_;
  mutable std::unordered_map<const Json*, Json>
      merged_;  ///< by the place in the schema; its elements stay where they are
};

}  // namespace

Validated validate(const Json& schema, const Json& document, const std::string& file) {
  Validated result{document, {}};
  Validator validator(schema, file);
  validator.check(schema, result.document, Json::json_pointer());
  result.defaults = std::move(validator.defaults);
  return result;
}

}  // namespace noli::integrator
