// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>

namespace noli::app {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command
      .add_option("--json", options.json,
                  "Write everything as JSON to this file; '-': to standard output, in place of the text")
      ->type_name("OUT");
  auto* const porcelain =
      command.add_flag("--porcelain", options.porcelain, "Print one line of key=value pairs, for programs");
  auto* const quiet = command.add_flag("-q,--quiet", options.quiet, "Print no result: the exit code says it");
  auto* const verbose = command.add_flag("-v,--verbose", options.verbose, "Print all that was looked at and done");
  quiet->excludes(porcelain)->excludes(verbose);
  verbose->excludes(porcelain);
  command.add_flag("--force", options.force, "Outputs may replace files that exist");
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "How many threads; 0: all there are")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
}

namespace {

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

CLI::Validator is_count() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        std::uint64_t number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        return whole ? "" : text + ": expected a whole number from 0";
      },
      "");
}

CLI::Validator is_dimension() {
  return CLI::Validator(
      [](const std::string& text) { return text == "2" || text == "3" ? "" : text + ": expected 2 or 3"; }, "");
}

}  // namespace noli::app
