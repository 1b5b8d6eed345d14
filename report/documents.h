// SPDX-License-Identifier: Apache-2.0
//
// Results as documents, and the JSON Schemas of what Noli reads and writes (schemas/), as they were when it was built.
#pragma once

#include <span>
#include <string_view>

#include "certify/json.h"

namespace noli::report {

struct SchemaText {
  std::string_view name;  ///< "scene", "verify"
  std::string_view text;
};

/// In the order of their names.
std::span<const SchemaText> schema_texts();

/// The result with its schema, the schema's version, and that of Noli before all else. Precondition: there is a schema
/// of this name.
Json document(std::string_view schema, Json result);

}  // namespace noli::report
