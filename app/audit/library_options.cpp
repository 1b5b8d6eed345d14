// SPDX-License-Identifier: Apache-2.0
#include "app/audit/library_options.h"

#include <fmt/format.h>

#include "app/options.h"
#include "app/process.h"
#include "certify/process/this_program.h"

namespace noli::app {

CLI::Option* add_sandbox_option(CLI::App& command, bool& sandbox) {
  return command.add_flag("--sandbox", sandbox,
                          "The library cannot write to files, touch other processes, or start programs");
}

void add_library_options(CLI::App& command, LibraryArguments& arguments, const std::string& instead) {
  audit::LibraryUnderTest& library = arguments.asked;
  CLI::Option* const path =
      command.add_option("--library", library.path, "Ask this library of collision detection instead of " + instead)
          ->type_name("LIB.so");
  command.add_option("--tolerance", library.tolerance, "The tolerance for the library, a length")
      ->check(is_not_negative())
      ->capture_default_str()
      ->type_name("T")
      ->needs(path);
  command
      .add_flag("--exact", library.exact,
                "The library claims to be exact: false positives and early times are findings too")
      ->needs(path);
  command.add_flag("--first-only", arguments.first_only, "Stop soon after the first finding")->needs(path);
  add_sandbox_option(command, library.host.sandbox)->needs(path);
  command.add_option("--query-limit", arguments.query_limit, "A query that takes longer counts as hung: 500ms, 10s")
      ->capture_default_str()
      ->type_name("TIME")
      ->needs(path);
  command
      .add_option("--memory-limit", arguments.megabytes,
                  "End the library's process when it uses more than this many megabytes")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str()
      ->type_name("MB")
      ->needs(path);
}

void settle_host(audit::HostOptions& host, const std::string& query_limit, std::uint64_t megabytes) {
  host.host = beside_this_program("noli_ccd_host");
  host.query_limit = parse_duration(query_limit, "--query-limit");
  host.most_memory = megabytes * 1'000'000;
  host.stop = &interrupted();
}

void settle_library(LibraryArguments& arguments) {
  settle_host(arguments.asked.host, arguments.query_limit, arguments.megabytes);
  arguments.asked.host.most_hangs = 4;
}

std::vector<std::string> library_words(const LibraryArguments& arguments) {
  if (!arguments.asks_a_library()) return {};
  const LibraryArguments usual;
  const audit::LibraryUnderTest& library = arguments.asked;
  std::vector<std::string> words = {"--library", library.path.string(), "--tolerance",
                                    fmt::format("{}", library.tolerance)};
  const auto add = [&](const char* option, const std::string& value) {
    words.emplace_back(option);
    words.push_back(value);
  };
  if (arguments.query_limit != usual.query_limit) add("--query-limit", arguments.query_limit);
  if (arguments.megabytes != usual.megabytes) add("--memory-limit", fmt::format("{}", arguments.megabytes));
  if (library.exact) words.emplace_back("--exact");
  if (library.late_tolerance > 0) add("--late-tolerance", fmt::format("{}", library.late_tolerance));
  return words;
}

}  // namespace noli::app
