// SPDX-License-Identifier: Apache-2.0
#include "report/documents.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include <noli/version.h>

namespace noli::report {
namespace {

Json version_of(std::string_view schema) {
  for (const SchemaText& one : schema_texts()) {
    if (one.name == schema) return Json::parse(one.text).at("properties").at("version").at("const");
  }
  throw std::logic_error("no schema of this name");
}

}  // namespace

Json document(std::string_view schema, Json result) {
  Json whole = {{"schema", fmt::format("noli-{}", schema)},
                {"version", version_of(schema)},
                {"noli", {{"version", version_number()}, {"commit", version_commit()}}}};
  for (const auto& item : result.items()) whole[item.key()] = std::move(item.value());
  return whole;
}

}  // namespace noli::report
