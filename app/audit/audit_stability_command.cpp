// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
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
#include "audit/ccd/audit_report.h"
#include "audit/numerics/stability.h"
#include "certify/process/this_program.h"
#include "certify/result_file.h"
#include "certify/stopwatch.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

using audit::StabilityPoint;
using audit::StabilityReport;
using audit::StabilityResult;
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

const char* verdict(const StabilityReport& report) {
  if (report.findings() > 0) return "finding";
  return report.complete ? "no_finding" : "undecided";
}

// --- JSON ------------------------------------------------------------------------------------------------------------

Json point_json(const StabilityPoint& point) {
  return {{"value", point.value},
          {"exit_code", point.exit_code},
          {"holds", point.gives.empty()},
          {"gives", point.gives.empty() ? Json(nullptr) : Json(point.gives)},
          {"message", point.message},
          {"energy_error", or_null(point.energy_error)},
          {"momentum_error", or_null(point.momentum_error)},
          {"findings", point.findings},
          {"saved", point.saved.empty() ? Json(nullptr) : Json(point.saved.string())}};
}

Json row_json(const StabilityResult& row) {
  Json json = {{"row", row.name}, {"varied", row.varied}, {"contact", row.contact}};
  const std::size_t first = row.first_to_give();
  json["holds_up_to"] = first > 0 ? Json(row.points[first - 1].value) : Json(nullptr);
  json["gives_first"] = first < row.points.size() ? Json(row.points[first].gives) : Json(nullptr);
  json["at"] = first < row.points.size() ? Json(row.points[first].value) : Json(nullptr);
  json["exit_code"] = first < row.points.size() ? Json(row.points[first].exit_code) : Json(nullptr);
  json["points"] = Json::array();
  for (const StabilityPoint& point : row.points) json["points"].push_back(point_json(point));
  return json;
}

Json stability_json(const StabilityReport& report, double seconds) {
  Json json = {{"verdict", verdict(report)},
               {"points", report.points()},
               {"held", report.held()},
               {"findings", report.findings()},
               {"complete", report.complete},
               {"most_energy_error", audit::most_energy_error},
               {"most_momentum_error", audit::most_momentum_error}};
  json["rows"] = Json::array();
  Json times = Json::array();
  for (const StabilityResult& row : report.rows) {
    json["rows"].push_back(row_json(row));
    Json of_points = Json::array();
    for (const StabilityPoint& point : row.points) of_points.push_back(point.seconds);
    times.push_back({{"row", row.name}, {"seconds", of_points}});
  }
  json["timing"] = {{"seconds", seconds}, {"rows", times}};
  return json;
}

// --- text ------------------------------------------------------------------------------------------------------------

std::string table(const StabilityReport& report) {
  std::vector<audit::TableRow> rows = {{"row", "varied", "up to", "energy", "momentum", "gives first", "at", "exit"}};
  for (const StabilityResult& row : report.rows) {
    const std::size_t first = row.first_to_give();
    const bool gives = first < row.points.size();
    double energy = 0, momentum = 0;
    for (std::size_t i = 0; i < first; ++i) {
      energy = std::max(energy, row.points[i].energy_error.value_or(0));
      momentum = std::max(momentum, row.points[i].momentum_error.value_or(0));
    }
    rows.push_back({row.name, row.varied, first > 0 ? fmt::format("{:g}", row.points[first - 1].value) : "-",
                    energy > 0 ? fmt::format("{:.1e}", energy) : "-",
                    momentum > 0 ? fmt::format("{:.0e}", momentum) : "-", gives ? row.points[first].gives : "-",
                    gives ? fmt::format("{:g}", row.points[first].value) : "-",
                    gives ? std::to_string(row.points[first].exit_code) : "-"});
  }
  return audit::table_text(rows, 2);
}

report::Answer stability_answer(const Json& json, const StabilityReport& report, double seconds) {
  report::Answer answer(json, {"rows", "points", "held", "findings", "complete"});
  std::string& text = answer.text;
  text += table(report);
  const auto out = std::back_inserter(text);
  for (const StabilityResult& row : report.rows) {
    for (const StabilityPoint& point : row.points) {
      if (!point.gives.empty()) {
        fmt::format_to(out, "{}, {:g}: {}, exit {}: {}\n", row.name, point.value, point.gives, point.exit_code,
                       point.message);
      }
      for (const std::string& words : point.findings) {
        fmt::format_to(out, "finding: {}, {:g}: {}; its input is in {}\n", row.name, point.value, words,
                       on_one_line(point.saved.string()));
      }
    }
  }
  fmt::format_to(out, "Time: {:.1f} s.\n", seconds);
  return answer;
}

// --- command ---------------------------------------------------------------------------------------------------------

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
  const Json json = stability_json(report, seconds);
  output.write("audit-stability", stability_answer(json, report, seconds), json);
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
