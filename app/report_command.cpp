// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "certify/json.h"
#include "report/page/assemble_page.h"
#include "report/page/report_page.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* report_footer =
    "Writes one self-contained page for any browser, also without a network: verdict, motion and contacts, statement, "
    "energies, steps and gaps over time, tables of audits, pictures. It decides nothing again.\n"
    "\n"
    "Inputs come in any order: one run; results that noli wrote with --json; the frames that a result of "
    "`noli verify` is about; pictures (.svg). A result of `noli repair` brings its frames, given and repaired.\n"
    "Examples:\n"
    "  noli verify a.ply b.ply --json ab.json; noli report ab.json a.ply b.ply -o ab.html\n"
    "  noli report runs/cloth -o cloth.html --open\n"
    "  noli verify runs/cloth --json cloth.json; noli report runs/cloth cloth.json -o cloth.html\n"
    "  noli report mended.json -o mended.html    both motions of noli repair --json mended.json\n"
    "  noli report audit.json audit.svg -o audit.html\n";

constexpr double most_rate = 1000;  ///< frames a second

struct ReportArguments {
  report::PageRequest page;
  fs::path output;
  bool force = false;
  bool open = false;  ///< in a browser, once it is written
  std::string time_limit;
};

CLI::Validator is_rate() {
  return CLI::Validator(
      [](const std::string& text) {
        const double rate = std::strtod(text.c_str(), nullptr);  // is_positive() has seen that it is a number
        return rate <= most_rate ? "" : fmt::format("{}: expected at most {}", text, most_rate);
      },
      "");
}

/// By the program that the desktop, or $BROWSER, has for it. A machine without one gets a note.
void open_in_browser(const fs::path& page) {
  const char* const chosen = std::getenv("BROWSER");
  const std::string browser = chosen != nullptr && *chosen != '\0' ? chosen : "xdg-open";
  const std::string path = fs::absolute(page).string();
  std::vector<char*> words = {const_cast<char*>(browser.c_str()), const_cast<char*>(path.c_str()), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, browser.c_str(), nullptr, nullptr, words.data(), environ) != 0) {
    tell_note(fmt::format("{} cannot be started; open {} in a browser", browser, path));
  }
}

report::AssembledPage assemble(report::PageRequest request) {
  std::optional<ProgressBars> bars(std::in_place);
  request.limits.progress = [&](double share) { bars->show("report", share); };
  return report::assemble_page(request, note_if_being_written, [&] { bars.reset(); });
}

ExitCode run(const ReportArguments& arguments) {
  begin_work(arguments.time_limit);
  if (!report::has_report_page())
    throw UsageError("this noli was built without reports; build it with NOLI_WITH_REPORT=ON");
  require_output_files({{"-o", arguments.output, true}}, arguments.page.inputs, arguments.force);
  const report::AssembledPage assembled = assemble(arguments.page);
  const std::string html = report::report_html(assembled.report);
  replace_file(arguments.output, html);
  const Json& scene = assembled.report.page["scene"];
  if (arguments.open) open_in_browser(arguments.output);
  report::Answer answer("written");
  answer.place = fmt::format("{}  {} frames, {} bytes", on_one_line(arguments.output.string()),
                             scene.is_null() ? 0 : scene["frames"].get<std::uint64_t>(), html.size());
  if (assembled.lacks_motion)
    answer.next = "name the frames or the run with the result, and the page shows the motion.";
  write_words(answer);
  return ExitCode::holds;
}

}  // namespace

Command add_report(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("report", "Write a page about a run, a verdict or an audit, for a browser");
  command->footer(report_footer);
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("inputs", arguments->page.inputs, "A run; results (--json); frames; pictures")
      ->required()
      ->type_name("RUN | RESULT.json");
  command->add_option("-o,--output", arguments->output, "The page")->required()->type_name("OUT.html");
  command->add_option("--title", arguments->page.title, "Its heading")->type_name("TEXT");
  add_order_option(*command, arguments->page.order);
  add_keys_option(*command, arguments->page.keys);
  command->add_option("--fps", arguments->page.limits.fps, "At most this many frames per simulated second")
      ->check(is_positive())
      ->check(is_rate())
      ->capture_default_str();
  command->add_flag("--open", arguments->open, "Open the page in a browser");
  command->add_flag("--force", arguments->force, "Replace an existing page");
  add_time_limit_option(*command, arguments->time_limit, "Stop after this time, without a page: 500ms, 60s, 5m, 1h");
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
