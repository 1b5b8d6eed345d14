// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "noli/app/checker.h"
#include "noli/app/commands.h"
#include "noli/app/frame_options.h"
#include "noli/app/input_report.h"
#include "noli/app/options.h"
#include "noli/app/output.h"
#include "noli/trajectory/error.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    "Runs the checker, a small program of its own that trusts nothing of this one (proofs/FORMAT.md, proofs/checker).\n"
    "Exit codes: 0 every step has a proof and each of them holds; 1 the motion touches, and a witness shows it; 3 "
    "anything else.\n"
    "Examples:\n"
    "  noli check proof.noli before.ply after.ply\n"
    "  noli check runs/cloth                      its proof.blocks, about its trajectory.blocks\n"
    "  noli check proof.noli runs/cloth --verified";

struct CheckArguments {
  std::vector<fs::path> files;
  bool verified = false;
  FrameOrder order = FrameOrder::checked;
  std::optional<std::string> json;
};

ExitCode run(const CheckArguments& arguments) {
  const bool folder = arguments.files.size() == 1 && fs::is_directory(arguments.files[0]);
  if (!folder && arguments.files.size() < 2) {
    throw UsageError("expected the folder of a run, or a proof and what it is about");
  }
  const fs::path proof = folder ? arguments.files[0] / "proof.blocks" : arguments.files[0];
  const OrderedFrames ordered =
      order_frames(folder ? arguments.files : std::vector<fs::path>(arguments.files.begin() + 1, arguments.files.end()),
                   arguments.order);
  const std::vector<fs::path>& trajectory = ordered.frames;
  if (!fs::exists(proof)) {
    const char* why = folder ? " (a run that is recorded as frames, or with --no-proof, has none)" : "";
    throw InputError(proof.string(), "", std::string("is not there; expected a proof") + why);
  }
  if (fs::is_directory(proof)) throw UsageError(proof.string() + ": is a folder; expected a proof, or one run alone");
  const Output output(arguments.json, arguments.files);
  CheckerProcess checker(arguments.verified ? Checker::verified : Checker::plain, proof,
                         trajectory_for_checker(trajectory), std::nullopt);
  const auto said = checker.finish();
  if (!said) throw ReadInterrupted(proof.string());
  const CheckerVerdict& verdict = *said;
  const char* word = verdict.code == 0 ? "accepted" : verdict.code == 1 ? "refuted" : "rejected";
  output.write(std::string("verdict ") + word + "\n" + verdict.words + notes_text(ordered.notes),
               {{"verdict", word},
                {"checker", arguments.verified ? "verified" : "plain"},
                {"proof", proof.string()},
                {"words", verdict.words},
                {"notes", ordered.notes}});
  return static_cast<ExitCode>(verdict.code);
}

}  // namespace

Command add_check(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("check", "Does a proof hold?");
  command->footer(footer);
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("files", arguments->files, "A proof, then PLY or OBJ files or a run; or a run alone")
      ->required()
      ->type_name("PROOF TRAJECTORY | RUN");
  command->add_flag("--verified", arguments->verified, "Use the checker that was extracted from its proof in Coq");
  add_order_option(*command, arguments->order);
  add_json_option(*command, arguments->json);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
