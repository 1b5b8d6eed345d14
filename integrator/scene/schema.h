// SPDX-License-Identifier: Apache-2.0
//
// The JSON Schema of scenes (schemas/scene.json), which is part of the program, and documents against it: known fields,
// types, ranges and defaults are said there and nowhere else.
//
// The subset of JSON Schema 2020-12 that it is written in
//   $ref (into #/$defs), type, const, enum, minimum, maximum, exclusiveMinimum, exclusiveMaximum, minLength, items,
//   minItems, maxItems, properties, required, additionalProperties (false), minProperties, maxProperties, default
//   oneOf     its alternatives are objects; the first field that each requires, and the others do not have, tells which
//             is meant
//   $schema, $defs, title, description   say what they say
//   unit      ours: what a number counts, for messages
//
// What this does not do: it is no general validator. A keyword that is not in the list is a fault of the schema, and
// thrown as std::logic_error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "integrator/scene/json_text.h"

namespace noli::integrator {

/// schemas/scene.json, as it was when the program was built.
std::string_view scene_schema_text();

/// A field that a document leaves to its default.
struct DefaultTaken {
  std::string path;  ///< JSON pointer
  Json value;
  friend bool operator==(const DefaultTaken&, const DefaultTaken&) = default;
};

/// What a document says, and what it does not.
struct Validated {
  Json document;                       ///< every field with a default is there
  std::vector<DefaultTaken> defaults;  ///< scalars, and lists as a whole, in the order of the schema
};

/// Checks a document against a schema and fills in defaults. Throws InputError whose place is the JSON pointer, and
/// which says what was expected; a field that is not known is answered with the nearest known one.
Validated validate(const Json& schema, const Json& document, const std::string& file);

}  // namespace noli::integrator
