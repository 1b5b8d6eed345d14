// SPDX-License-Identifier: Apache-2.0
//
// Validates documents against the JSON Schema of scenes (schemas/scene.json), which is part of the program. Only the
// schema defines known fields, types, ranges and defaults.
//
// The schema uses this subset of JSON Schema 2020-12:
//   $ref (into #/$defs), type, const, enum, minimum, maximum, exclusiveMinimum, exclusiveMaximum, minLength, items,
//   minItems, maxItems, properties, required, additionalProperties (false), minProperties, maxProperties, default
//   oneOf     its alternatives are objects; the first field that each requires, and the others do not have, decides
//             which is meant
//   $schema, $defs, title, description   as in the standard
//   unit      our own keyword: the unit of a number, for messages
//
// It is not a general validator. Any other keyword is a fault of the schema, and throws std::logic_error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "integrator/scene/json_text.h"

namespace noli::integrator {

/// The text of schemas/scene.json when the program was built.
std::string_view scene_schema_text();

/// A field that a document leaves to its default.
struct DefaultTaken {
  std::string path;  ///< JSON pointer
  Json value;
  friend bool operator==(const DefaultTaken&, const DefaultTaken&) = default;
};

/// A document, and the fields that it leaves out.
struct Validated {
  Json document;                       ///< with every field that has a default
  std::vector<DefaultTaken> defaults;  ///< scalars, and lists as a whole, in the order of the schema
};

/// Checks a document against a schema and fills in defaults. Throws an InputError with the JSON pointer as its place,
/// and what was expected; for an unknown field it names the nearest known one.
Validated validate(const Json& schema, const Json& document, const std::string& file);

}  // namespace noli::integrator
