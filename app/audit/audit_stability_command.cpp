// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/numerics/stability.h"
#include "audit/numerics/stability_report.h"
#include "certify/process/this_program.h"
#include "certify/result_file.h"
#include "certify/stopwatch.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

using audit::StabilityReport;
using audit::StabilityRow;

constexpr const char* stability_footer =
    "Each row takes small scenes or pairs of frames from the ordinary to the extreme in one quantity: stiffness, mass, "
    "thickness, speed, offset, magnitude, slivers, subnormals, steps, resonance; with and without contact. Each point "
    "runs the `noli` program as a user would and checks the result. Does the run end? Is it verified again? Are energy "
    "and momentum kept? Does it resume with the same bytes? A run that fails must not exit with 0.\n"
    "\n"
    "Exit codes: 0 all failures failed closed; 1 a finding, whose input is kept in --out; 2 interrupted.\n"
    "Examples:\n"
    "  noli audit stability\n"
    "  noli audit stability --row offset --row offset-contact --json result.json\n"
    "  noli audit stability --svg stability.svg\n"
    "  noli audit stability --program build/asan/app/noli --point-limit 2m\n";

struct StabilityArguments {
  audit::StabilityOptions options;
  std::vector<std::string> rows;
  std::uint64_t points = 100;
  std::string point_limit = "20s";
  std::string out = "stability-findings";
  std::optional<std::string> program, svg;
  OutputOptions results;
};

std::vector<StabilityRow> chosen_rows(const std::vector<std::string>& names) {
  std::vector<StabilityRow> all = audit::stability_rows();
  if (names.empty()) return all;
  std::vector<StabilityRow> chosen;
  for (const std::string& name : names) {
    const auto row = std::ranges::find(all, name, &StabilityRow::name);
    if (row == all.end()) {
      std::vector<std::string> known(all.size());
      std::ranges::transform(all, known.begin(), &StabilityRow::name);
      throw UsageError(
          fmt::format("--row: there is no row {}; choose one of {}", on_one_line(name), fmt::join(known, ", ")));
    }
    chosen.push_back(*row);
  }
  return chosen;
}

ExitCode run(StabilityArguments& arguments) {
  audit::StabilityOptions& options = arguments.options;
  std::vector<StabilityRow> rows = chosen_rows(arguments.rows);
  for (StabilityRow& row : rows) row.values.resize(std::min<std::size_t>(row.values.size(), arguments.points));
  options.point_limit = parse_duration(arguments.point_limit, "--point-limit");
  if (arguments.program) require_program(*arguments.program, "--program");
  options.program = arguments.program ? std::filesystem::absolute(*arguments.program) : this_program_file();
  const Output output(arguments.results, {options.program}, outputs("--svg", arguments.svg));
  require_writable_folder(arguments.out, "--out");
  options.out = arguments.out;
  options.stop = &interrupted();
  std::string now;
  options.progress = [&](double share, const std::string& row) {
    if (row == now) return;
    now = row;
    std::fputs(fmt::format("noli: {:3.0f} % {}\n", 100 * share, row).c_str(), stderr);
  };
  const Stopwatch watch;
  const StabilityReport report = audit::audit_stability(rows, options);
  const double seconds = watch.seconds();
  if (arguments.svg) write_file(*arguments.svg, audit::stability_svg(report));
  const Json json = audit::stability_json(report, seconds);
  output.write("audit-stability", audit::stability_answer(json, report, seconds), json);
  return exit_code_of(report.findings() > 0, report.complete);
}

}  // namespace

Command add_audit_stability(CLI::App& audit) {
  CLI::App* const command =
      audit.add_subcommand("stability", "How far does noli go, and how does it fail beyond that?");
  command->footer(stability_footer);
  const auto arguments = std::make_shared<StabilityArguments>();
  command->add_option("--row", arguments->rows, "Only this row; may be given more than once")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command->add_option("--points", arguments->points, "Only the first N points of each row")
      ->check(whole_number(1, 100))
      ->type_name("N");
  command->add_option("--point-limit", arguments->point_limit, "A run that takes longer ends undecided: 500ms, 20s, 1m")
      ->capture_default_str()
      ->type_name("TIME");
  command->add_option("--program", arguments->program, "Run this `noli` program instead")
      ->check(CLI::ExistingFile)
      ->type_name("NOLI");
  command->add_option("--out", arguments->out, "Folder for the input of findings, created for the first one")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_option("--svg", arguments->svg, "Draw up to which value each row holds")->type_name("OUT.svg");
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
