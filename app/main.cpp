// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <noli/errors.h>
#include <noli/version.h>
#include "app/commands.h"
#include "app/output.h"
#include "app/process.h"
#include "trajectory/stop.h"

namespace noli::app {
namespace {

constexpr const char* description = "Noli proves that things that move do not touch: exact answers, no tolerance.";
constexpr const char* program_footer =
    "Exit codes: 0 what was asked holds; 1 it does not; 2 undecided (limit, interrupt); 3 the input or the command "
    "line is at\n"
    "fault; 4 an internal check failed, or the machine did.\n"
    "Examples:\n"
    "  noli verify before.ply after.ply       did anything touch between these frames?\n"
    "  noli verify frames/*.ply --json out.json\n"
    "  noli check proof.noli frames/*.ply     does a proof hold?\n"
    "  noli ccd edge-edge-queries.csv         decide queries, compare with their labels\n"
    "  noli simulate scene.json -o run        run a scene, certified window by window\n"
    "  noli info frame.obj                    what is in a file\n"
    "  noli report run -o report.html         a page about it, for a browser\n"
    "  noli schema verify                     the JSON Schema of a result\n"
    "  noli fuzz queries --for 60s --seed 1   adversarial queries, kernel against oracle\n"
    "  noli audit ccd --library lib.so edge-edge-queries.csv   somebody else's library against the truth\n"
    "  noli audit self                        all that noli has to look at itself with\n"
    "`noli COMMAND --help` says more.";

ExitCode complain(ExitCode code, const std::string& message) {
  std::fputs(fmt::format("noli: {}\n", on_one_line(message)).c_str(), stderr);
  return code;
}

/// CLI11 describes a fault in a line or two; the user gets one.
std::string joined_lines(std::string text) {
  for (char& c : text) c = c == '\n' ? ' ' : c;
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App app(description, "noli");
  app.footer(program_footer);
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text, "Print version, commit, arithmetic libraries, rounding self-test");
  std::vector<Command> commands = {
      add_verify(app),  add_check(app),  add_ccd(app),    add_info(app),   add_simulate(app),
      add_explain(app), add_export(app), add_report(app), add_schema(app),
  };
  std::ranges::move(add_audits(app), std::back_inserter(commands));
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    write_standard_output(app.help());  // of the subcommand, where one was given
    return ExitCode::holds;
  } catch (const CLI::CallForVersion&) {
    write_standard_output(version_text());
    return ExitCode::holds;
  } catch (const CLI::ParseError& error) {
    return complain(ExitCode::bad_input, joined_lines(error.what()) + " (see noli --help)");
  }
  for (const Command& command : commands) {
    if (command.parser->parsed()) return command.run();
  }
  return complain(ExitCode::failure, "internal error: a command without an action");
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
  noli::app::prepare_for_the_worst();
  noli::app::install_signal_handlers();
  return static_cast<int>(noli::app::guarded(argc, argv));
}
