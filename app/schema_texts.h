// SPDX-License-Identifier: Apache-2.0
//
// The JSON Schemas of what `noli` reads and writes (schemas/), as they were when the program was built.
#pragma once

#include <span>
#include <string_view>

namespace noli::app {

struct SchemaText {
  std::string_view name;  ///< "scene", "verify"
  std::string_view text;
};

/// In the order of their names.
std::span<const SchemaText> schema_texts();

}  // namespace noli::app
