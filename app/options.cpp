// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <charconv>
#include <optional>
#include <regex>
#include <string_view>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include <noli/errors.h>
#include "app/help.h"
#include "app/process.h"
#include "trajectory/text.h"

namespace noli::app {
namespace {

std::optional<double> seconds_per(std::string_view unit) {
  if (unit.empty() || unit == "s") return 1.0;
  if (unit == "ms") return 1e-3;
  if (unit == "m") return 60.0;
  if (unit == "h") return 3600.0;
  return std::nullopt;
}

/// Finite numbers, of which `accepts` is true; `what` is what is expected.
CLI::Validator numbers(bool (*accepts)(double), const char* what) {
  return CLI::Validator(
      [accepts, what](const std::string& text) -> std::string {
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        return whole && accepts(number) && std::isfinite(number) ? "" : text + ": expected a number " + what;
      },
      "");
}

}  // namespace

void add_output_options(CLI::App& command, OutputOptions& options) {
  command
      .add_option("--json", options.json,
                  "Write the whole result as JSON to this file; '-': to standard output, instead of the text")
      ->type_name("OUT")
      ->group(group::output);
  auto* const porcelain =
      command.add_flag("--porcelain", options.porcelain, "Print one line of key=value pairs, for programs")
          ->group(group::output);
  auto* const quiet =
      command.add_flag("-q,--quiet", options.quiet, "Print nothing; use the exit code")->group(group::output);
  auto* const verbose =
      command
          .add_flag("-v,--verbose", options.verbose, "Also print the statement, each file, each contact, and the work")
          ->group(group::output);
  quiet->excludes(porcelain)->excludes(verbose);
  verbose->excludes(porcelain);
  command.add_flag("--force", options.force, "Let outputs replace existing files")->group(group::output);
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Number of threads; 0: all")
      ->check(CLI::Range(0, 1024))
      ->type_name("N")
      ->group(group::limits);
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t greatest) {
  const auto problem = [=](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size() && (text.size() == 1 || text[0] != '0');
    if (whole && value >= least && value <= greatest) return {};
    return fmt::format("{}: expected a whole number from {} to {}", text, least, greatest);
  };
  return CLI::Validator(problem, "");
}

CLI::Validator is_positive() {
  return numbers([](double x) { return x > 0; }, "above 0");
}

CLI::Validator is_not_negative() {
  return numbers([](double x) { return x >= 0; }, "from 0");
}

CLI::Validator is_share() {
  return numbers([](double x) { return x >= 0 && x <= 1; }, "from 0 to 1");
}

CLI::Validator is_dimension() {
  return CLI::Validator(
      [](const std::string& text) { return text == "2" || text == "3" ? "" : text + ": expected 2 or 3"; }, "");
}

std::chrono::nanoseconds parse_duration(const std::string& text, const std::string& option) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  const auto unit = seconds_per(std::string_view(rest, static_cast<std::size_t>(end - rest)));
  constexpr double ten_years = 10 * 366 * 24 * 3600.0;
  const double seconds = number * unit.value_or(0);
  if (error != std::errc() || !(seconds > 0 && seconds <= ten_years)) {
    throw UsageError(option + ": '" + text +
                     "' is not a duration; expected a positive number with ms, s, m or h, as in 60s");
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

void add_time_limit_option(CLI::App& command, std::string& text, const std::string& help) {
  command.add_option("--time-limit", text, help)->type_name("TIME")->group(group::limits);
}

std::optional<std::chrono::steady_clock::time_point> begin_work(const std::string& text) {
  hear_stops_everywhere();
  if (text.empty()) return std::nullopt;
  const std::chrono::nanoseconds limit = parse_duration(text, "--time-limit");
  const auto deadline = std::chrono::steady_clock::now() + limit;
  stop_after(limit);
  return deadline;
}

ShardNumber parse_shard(const std::string& text) {
  static const std::regex form("([1-9][0-9]{0,8})/([1-9][0-9]{0,8})");
  std::smatch match;
  if (text.size() < 32 && std::regex_match(text, match, form)) {
    const ShardNumber shard{std::stoull(match[1].str()), std::stoull(match[2].str())};
    if (shard.number <= shard.of) return shard;
  }
  throw UsageError(fmt::format("--shard {}: expected K/N with 1 <= K <= N, such as 3/64", on_one_line(text)));
}

void add_order_option(CLI::App& command, FrameOrder& order) {
  command
      .add_option_function<std::string>(
          "--order",
          [&order](const std::string& word) { order = word == "natural" ? FrameOrder::natural : FrameOrder::given; },
          "natural sorts frames by the numbers in their names, given keeps them as they are. Without it, frames out of "
          "order by these numbers are an error")
      ->check(CLI::IsMember({"natural", "given"}))
      ->type_name("natural|given");
}

void add_keys_option(CLI::App& command, std::vector<std::string>& keys) {
  command
      .add_option("--keys", keys,
                  "Names of arrays in a .npz file: the positions, then faces (edges, points); default: those that are "
                  "unambiguous")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("POSITIONS,FACES")
      ->group(group::question);
}

void add_polygons_option(CLI::App& command, PolygonRule& polygons) {
  command
      .add_option_function<std::string>(
          "--polygons",
          [&polygons](const std::string& word) { polygons = word == "fan" ? PolygonRule::fan : PolygonRule::refuse; },
          "fan (the default) cuts faces of more than three corners into triangles that begin at the first corner; "
          "refuse makes them an error")
      ->check(CLI::IsMember({"fan", "refuse"}))
      ->type_name("fan|refuse")
      ->group(group::question);
}

}  // namespace noli::app
