// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/version.h>
#include "app/commands.h"
#include "app/help.h"
#include "app/output.h"
#include "app/process.h"
#include "app/terminal.h"
#include "app/wrong_usage.h"
#include "certify/process/this_program.h"
#include "certify/proofs/checker.h"
#include "certify/ranks/ranks.h"
#include "report/figures/png.h"
#include "report/page/report_page.h"
#include "trajectory/stop.h"

namespace noli::app {
namespace {

constexpr const char* description = "did anything touch? Exact answers, with proofs.";
constexpr const char* program_footer =
    "Exit codes: 0 what was asked holds; 1 it does not; 2 undecided (a limit, an interruption);\n"
    "3 the input or the command line is at fault; 4 an internal check failed, or the machine did.\n"
    "Examples:\n"
    "  noli verify before.ply after.ply              did anything touch between these frames?\n"
    "  noli verify frames/*.ply --json result.json   the same for a sequence, with a result for programs\n"
    "  noli report result.json frames/*.ply -o report.html   where, as a page for a browser\n"
    "  noli check proof.noli frames/*.ply            does a proof hold?\n"
    "  noli simulate scene.json -o run               run a scene, certified window by window\n"
    "  noli fuzz queries --library ./mine.so         look for wrong answers of a collision library\n"
    "  noli audit ccd --library ./mine.so edge-edge.csv      compare a library with the exact truth\n"
    "  noli help verify                              all about one command\n";

ExitCode complain(ExitCode code, const std::string& message) {
  std::fputs(fmt::format("noli: {} {}\n", inked("error:", Ink::red, STDERR_FILENO), on_one_line(message)).c_str(),
             stderr);
  return code;
}

bool is_beside_this(const char* program) {
  std::error_code error;
  return std::filesystem::exists(beside_this_program(program), error);
}

/// Which parts this noli was built or installed without: "without reports, pictures", or "with all parts".
std::string parts_text() {
  std::vector<const char*> without;
  if (!has_checker(Checker::plain)) without.push_back("proof checker");
  if (!has_checker(Checker::verified)) without.push_back("verified checker");
  if (!report::has_report_page()) without.push_back("reports");
  if (!report::can_write_png()) without.push_back("pictures");
  if (!is_beside_this("noli_series")) without.push_back("series.h5");
  if (!Ranks::has_library()) without.push_back("MPI");
  if (!has_audits()) without.push_back("fuzz and audit");
  return without.empty() ? "with all parts\n" : fmt::format("without {}\n", fmt::join(without, ", "));
}

std::string version_and_parts() { return version_text() + parts_text(); }

/// `noli help COMMAND...`
Command add_help(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("help", "Print the help of a command");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("command", *words, "A command, with its subcommand")->type_name("COMMAND");
  command->footer("Examples:\n  noli help verify\n  noli help fuzz queries\n");
  return {command, [&app, words] {
            std::vector<std::string> rest;
            CLI::App& named = named_command(app, *words, rest);
            if (!rest.empty()) throw UsageError(unknown_command(named, rest.front()));
            write_standard_output(help_of(named));
            return ExitCode::holds;
          }};
}

/// A command that needs another one, without it: the help says what there is. Not 0, for scripts that forgot a word.
ExitCode show_help(const CLI::App& command) {
  write_standard_output(help_of(command));
  return ExitCode::bad_input;
}

/// The command line of one command, or of all. All of them take 8,000 allocations, most of them for help texts.
class Program {
 public:
  /// `only`: the name of a command; another word: all of them.
  explicit Program(std::string_view only) : app_(description, "noli") {
    use_help(app_);
    app_.footer(program_footer);
    app_.require_subcommand(1);
    app_.set_version_flag("-V,--version", version_and_parts,
                          "Print version, commit, libraries, rounding self-test, and parts");
    const bool known = is_command(only);
    for (const auto& [name, add] : plain_commands) {
      if (!known || name == only) commands_.push_back(add(app_));
    }
    if (!known || is_audit(only)) std::ranges::move(add_audits(app_), std::back_inserter(commands_));
    if (!known) commands_.push_back(add_help(app_));
  }
  // Commands refer to the parser.
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  static bool is_command(std::string_view word) {
    return is_audit(word) || std::ranges::any_of(plain_commands, [&](const auto& of) { return of.first == word; });
  }
  CLI::App& app() { return app_; }

  /// Nothing if run() is to follow: it did not ask for help alone. Throws CLI::ParseError for a wrong command line.
  std::optional<ExitCode> parse(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
      write_standard_output(app_.help());  // of the subcommand, where one was given
      return ExitCode::holds;
    } catch (const CLI::CallForVersion&) {
      write_standard_output(version_and_parts());
      return ExitCode::holds;
    }
    return std::nullopt;
  }

  ExitCode run() const {
    for (const Command& command : commands_) {
      if (!command.parser->parsed()) continue;
      const std::string name = command.parser->get_name();
      if (Ranks::started_by_mpirun() && name != "verify" && name != "check") {
        throw UsageError(
            fmt::format("mpirun started several ranks, but `noli {}` runs in one process; start it without mpirun, or "
                        "with NOLI_MPI=0",
                        name));
      }
      return command.run();
    }
    return complain(ExitCode::failure, "internal error: a command without an action");
  }

 private:
  static constexpr std::array<std::pair<std::string_view, Command (*)(CLI::App&)>, 11> plain_commands = {
      {{"verify", add_verify},
       {"merge", add_merge},
       {"check", add_check},
       {"simulate", add_simulate},
       {"explain", add_explain},
       {"repair", add_repair},
       {"export", add_export},
       {"report", add_report},
       {"info", add_info},
       {"ccd", add_ccd},
       {"schema", add_schema}}};
  static bool is_audit(std::string_view word) { return word == "audit" || word == "fuzz"; }

  CLI::App app_;
  std::vector<Command> commands_;
};

ExitCode parse_and_run(int argc, char** argv) {
  if (argc > 1 && Program::is_command(argv[1])) {
    Program program(argv[1]);
    bool parsed = false;
    std::optional<ExitCode> helped;
    try {
      helped = program.parse(argc, argv);
      parsed = true;
    } catch (const CLI::ParseError&) {  // explained below, by a parser that knows all commands
    }
    if (parsed) return helped ? *helped : program.run();
  }
  Program program("");
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (const auto helped = program.parse(argc, argv)) return *helped;
  } catch (const CLI::ParseError& error) {
    if (const auto wrong = wrong_usage(program.app(), arguments, error)) return complain(ExitCode::bad_input, *wrong);
    std::vector<std::string> rest;
    return show_help(named_command(program.app(), arguments, rest));
  }
  return program.run();
}

ExitCode guarded(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const InputError& error) {
    return complain(ExitCode::bad_input, error.what());
  } catch (const Stopped& error) {
    return complain(ExitCode::undecided, error.what());
  } catch (const UsageError& error) {
    return complain(ExitCode::bad_input, error.what());
  } catch (const WriteError& error) {
    return complain(ExitCode::failure, error.what());
  } catch (const HelperError& error) {
    return complain(ExitCode::failure, error.what());
  } catch (const std::system_error& error) {
    return complain(ExitCode::failure, error.what());
  } catch (const std::bad_alloc&) {
    return complain(ExitCode::failure, "out of memory");
  } catch (const std::exception& error) {
    return complain(ExitCode::failure, fmt::format("internal error: {}", error.what()));
  }
}

}  // namespace
}  // namespace noli::app

int main(int argc, char** argv) {
  noli::app::return_large_memory();
  noli::app::prepare_for_the_worst();
  noli::app::install_signal_handlers();
  return static_cast<int>(noli::app::guarded(argc, argv));
}
