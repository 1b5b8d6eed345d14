// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/output.h"
#include "report/documents.h"

namespace noli::app {
namespace {

constexpr const char* schema_footer =
    "Each result that --json writes names its schema and version: \"schema\": \"noli-verify\", \"version\": "
    "1.\n"
    "Examples:\n"
    "  noli schema                         the names\n"
    "  noli schema verify > verify.json    what `noli verify --json` writes\n"
    "  noli schema scene                   what `noli simulate` reads\n";

std::string names() {
  std::string lines;
  for (const report::SchemaText& schema : report::schema_texts()) lines += std::string(schema.name) + '\n';
  return lines;
}

ExitCode run(const std::optional<std::string>& name) {
  if (!name) {
    write_standard_output(names());
    return ExitCode::holds;
  }
  constexpr std::string_view prefix = "noli-";  // as results name their schema
  std::string_view wanted = *name;
  if (wanted.starts_with(prefix)) wanted.remove_prefix(prefix.size());
  const auto found = std::ranges::find(report::schema_texts(), wanted, &report::SchemaText::name);
  if (found == report::schema_texts().end()) {
    throw UsageError(fmt::format("there is no schema {}; `noli schema` lists the names", on_one_line(*name)));
  }
  write_standard_output(std::string(found->text));
  return ExitCode::holds;
}

}  // namespace

Command add_schema(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("schema", "Print the JSON Schema of a result or a scene");
  command->footer(schema_footer);
  const auto name = std::make_shared<std::optional<std::string>>();
  command->add_option("name", *name, "Which one; without it, the names are listed")->type_name("NAME");
  return {command, [name] { return run(*name); }};
}

}  // namespace noli::app
