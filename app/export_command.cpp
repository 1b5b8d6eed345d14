// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string>

#include <noli/errors.h>
#include <noli/export.h>
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/progress.h"
#include "report/figures/contact_export.h"
#include "report/figures/export_report.h"
#include "report/figures/repair_picture.h"
#include "report/figures/run_figure.h"
#include "report/figures/run_picture.h"
#include "report/page/report_results.h"

namespace noli::app {
namespace {

constexpr const char* export_footer =
    "Frames are samples: straight lines between them are not the certified motion; the world lines of the "
    "run are.\n"
    "\n"
    "Figures: step-histogram (how long the steps of vertices are over time), energy, momentum. A figure is a "
    "picture (.svg) or its numbers (.csv).\n"
    "Examples:\n"
    "  noli export runs/cloth --fps 60 -o frames/%05d.ply\n"
    "  noli export result.json -o hits.vtu       the first contact that noli verify found, marked\n"
    "  noli export result.json -o first.png      a picture of it\n"
    "  noli export mended.json --at 12 -o after.png    of noli repair --json; --given: before\n"
    "  noli export runs/cloth --fps 24 -o paraview/cloth_%04d.vtu    and cloth.pvd, which ParaView opens\n"
    "  noli export runs/cloth --at 0.5 -o cloth.png --from 1 -2 0.5 --size 1280x720 --zoom cloth\n"
    "  noli export runs/cloth --fps 24 -o film/%04d.png --size 1280x720   a film\n"
    "  noli export runs/cloth --figure step-histogram -o steps.svg   or steps.csv\n";

struct ExportArguments {
  ExportRequest frames;
  bool fps_given = false;
  std::optional<std::string> figure;
  std::optional<double> at;
  std::optional<std::size_t> contact;
  std::optional<Position> from;
  std::string size, zoom;  ///< empty: not given
  bool given = false;      ///< of a repair
  std::string time_limit;
};

ExitCode draw(const report::FigureRequest& request) {
  write_words(report::figure_answer(request, report::run_figure(request)));
  return ExitCode::holds;
}

ExitCode paint(const report::PictureRequest& request) {
  write_words(report::picture_answer(request, report::run_picture(request)));
  return ExitCode::holds;
}

/// "1280x720". Throws UsageError.
std::optional<std::array<std::size_t, 2>> size_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  constexpr std::size_t least = 16, most = 8192;
  std::array<std::size_t, 2> size{};
  const char* const end = text.data() + text.size();
  const auto [x, wide] = std::from_chars(text.data(), end, size[0]);
  const bool separated = wide == std::errc() && x != end && *x == 'x';
  const auto [rest, tall] = std::from_chars(separated ? x + 1 : end, end, size[1]);
  const bool whole = separated && tall == std::errc() && rest == end;
  if (!whole || std::ranges::any_of(size, [](std::size_t n) { return n < least || n > most; })) {
    throw UsageError(fmt::format("--size {}: expected WIDTHxHEIGHT in pixels, each from {} to {}", text, least, most));
  }
  return size;
}

/// A motion of a result of noli repair.
ExitCode show_repair(const ExportArguments& arguments) {
  const ExportRequest& request = arguments.frames;
  if (!arguments.at || !request.pattern.ends_with(".png")) {
    throw UsageError("a result of noli repair: expected --at TIME, in steps, and -o with a name that ends in .png");
  }
  if (arguments.contact) throw UsageError("--contact: applies to results of noli verify; drop it for noli repair");
  require_output_files({{"-o", request.pattern, true}}, {request.run}, request.force);
  const report::PictureView view{arguments.from, size_of(arguments.size), arguments.zoom};
  const report::RepairPictureRequest picture{request.run, *arguments.at, arguments.given, view, request.pattern};
  write_words(report::repair_picture_answer(picture, report::repair_picture(picture)));
  return ExitCode::holds;
}

/// One contact of a result.
ExitCode show_contact(const ExportArguments& arguments) {
  const ExportRequest& request = arguments.frames;
  if (arguments.at || arguments.figure || !arguments.zoom.empty()) {
    const char* const option = arguments.at ? "--at" : arguments.figure ? "--figure" : "--zoom";
    throw UsageError(std::string(option) + ": is for a run; with a result the picture shows a contact");
  }
  if (arguments.fps_given || !arguments.time_limit.empty()) {
    throw UsageError("--fps, --time-limit: apply to runs only; drop them for a result");
  }
  const bool picture = request.pattern.ends_with(".png");
  if (!picture && (arguments.from || !arguments.size.empty())) {
    throw UsageError("--from, --size: are for pictures; expected -o with a name that ends in .png");
  }
  require_output_files({{"-o", request.pattern, true}}, {request.run}, request.force);
  const report::ContactExportRequest contact{
      request.run, arguments.contact.value_or(0), {arguments.from, size_of(arguments.size), ""}, request.pattern};
  write_words(report::contact_export_answer(contact, report::export_contact(contact)));
  return ExitCode::holds;
}

ExitCode run(const ExportArguments& arguments) {
  const ExportRequest& request = arguments.frames;
  begin_work(arguments.time_limit);
  const bool result = std::filesystem::is_regular_file(request.run);
  if (result && report::is_of_repair(report::read_result(request.run))) return show_repair(arguments);
  if (arguments.given) throw UsageError("--given: is for a result of noli repair (--json)");
  if (result) return show_contact(arguments);
  if (arguments.contact)
    throw UsageError("--contact: is for a result of noli verify (--json); expected no run with it");
  note_if_being_written(request.run);
  if (arguments.at || arguments.figure) {
    require_output_files({{"-o", request.pattern, true}}, {request.run}, request.force);
  }
  const report::PictureView view{arguments.from, size_of(arguments.size), arguments.zoom};
  if (arguments.at) return paint({request.run, *arguments.at, view, request.pattern});
  if (arguments.figure) return draw({request.run, *arguments.figure, request.pattern});
  const bool film = request.pattern.ends_with(".png");
  if (film && request.pattern.find('%') == std::string::npos) {
    throw UsageError("-o " + request.pattern +
                     ": expected --at TIME for one picture, or a name with one %d or %05d for a film");
  }
  if (!film && (view.from || view.size || !view.zoom.empty())) {
    throw UsageError("--from, --size, --zoom: are for pictures; expected --at, or -o with a pattern that ends in .png");
  }
  std::optional<ProgressBars> bars(std::in_place);
  ExportRequest told = request;
  told.progress = [&](double share) { bars->show("export", share); };
  const ExportOutcome outcome = film ? report::run_film({told, view}) : run_export(told);
  bars.reset();
  write_words(report::export_answer(request, outcome));
  return outcome.interrupted ? ExitCode::undecided : ExitCode::holds;
}

}  // namespace

Command add_export(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("export", "Write frames, pictures, films and figures of a run");
  command->footer(export_footer);
  const auto arguments = std::make_shared<ExportArguments>();
  ExportRequest* const request = &arguments->frames;
  command
      ->add_option("run", request->run,
                   "The folder of a run, a result of `noli verify --json` with a contact, or one of `noli repair`")
      ->required()
      ->type_name("RUN|RESULT.json");
  auto* const fps = command->add_option(
      "--fps", request->fps, "Frames a second of simulated time; without effect on a run that recorded frames");
  fps->check(is_positive())->capture_default_str();
  command
      ->add_option("-o,--output", request->pattern,
                   "Frames: a pattern such as frames/%05d.ply (or .obj, .vtu; .png for a film). A picture: .png; a "
                   "figure: .svg, .csv; a contact: .vtu, .png")
      ->required()
      ->type_name("PATTERN");
  command->add_flag("--force", request->force,
                    "Replace existing files of that pattern, and remove those that this export does not write; without "
                    "it they are an error");
  auto* const figure =
      command->add_option("--figure", arguments->figure, "Draw this instead: step-histogram, energy, momentum");
  figure->excludes(fps)->type_name("NAME");
  auto* const at =
      command->add_option("--at", arguments->at, "A picture of this time, in seconds, or in steps of a repair (.png)");
  at->excludes(fps)->excludes(figure);
  command->add_flag("--given", arguments->given, "With a result of `noli repair`: the motion as given");
  command->add_option("--from", arguments->from, "Direction from which a picture is seen: x y z, or x,y,z")
      ->delimiter(',');
  command->add_option("--size", arguments->size, "Pixels of a picture; default: 640 wide")->type_name("WxH");
  command
      ->add_option(
          "--zoom", arguments->zoom,
          "With a run: the body that fills the picture; default: all except fixed parts of at most four vertices")
      ->type_name("BODY");
  command
      ->add_option("--contact", arguments->contact,
                   "With a result: which of the listed contacts, from 1; default: the first")
      ->check(whole_number(1, 1'000'000'000))
      ->excludes(at)
      ->excludes(figure)
      ->type_name("N");
  add_time_limit_option(*command, arguments->time_limit, "Stop after this time: 500ms, 60s, 5m, 1h");
  return {command, [arguments, fps] {
            arguments->fps_given = fps->count() > 0;
            return run(*arguments);
          }};
}

}  // namespace noli::app
