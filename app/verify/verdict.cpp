// SPDX-License-Identifier: Apache-2.0
#include "app/verify/verdict.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "app/notes.h"
#include "app/process.h"
#include "app/progress.h"
#include "certify/process/child.h"
#include "certify/proofs/claim.h"
#include "certify/proofs/proof_route.h"
#include "certify/result_file.h"
#include "report/verify_ci.h"
#include "report/verify_report.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frames.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

/// The motion of a run, kept open: whoever replaces the run while it is read makes another file.
class MotionFile {
 public:
  explicit MotionFile(const VerifyWork& request) {
    if (!request.run) return;
    path_ = trajectory_path(request.frames[0]);
    file_.take(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  }

  bool was_replaced() const {
    struct stat opened = {}, named = {};
    if (file_.get() < 0 || ::fstat(file_.get(), &opened) != 0) return false;
    return ::stat(path_.c_str(), &named) != 0 || opened.st_dev != named.st_dev || opened.st_ino != named.st_ino;
  }

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

/// "step 3 of 11, cloth_4.obj": which part of the work a share of it is.
std::string where(const VerifyWork& request, std::string_view work, double share) {
  const std::size_t count = request.frames.size() - (work == "look" || request.constant_motion ? 0 : 1);
  const auto done = static_cast<std::size_t>(share * static_cast<double>(count));
  const std::size_t number = std::min(done + 1, count), frame = request.frames.size() - count + number - 1;
  return fmt::format("{} {} of {}, {}", work == "look" ? "frame" : "step", number, count,
                     on_one_line(request.frames[frame].filename().string()));
}

VerifyOutcome verify(const VerifyWork& request, ProofRoute& route) {
  const MotionFile motion(request);
  try {
    VerifyOutcome outcome = run_verify(request);
    route.check(outcome);
    return outcome;
  } catch (const std::exception&) {
    if (!motion.was_replaced()) throw;
    throw InputError(request.frames[0].string(), "", "was replaced while it was read; verify it again");
  }
}

}  // namespace

std::vector<OutputFile> files_of(const VerifyWork& request, const VerdictOutputs& outputs) {
  std::vector<OutputFile> files;
  if (const auto& proof = request.proof) {
    if (*proof == "-") throw UsageError("--proof -: a proof is not text; expected the name of a file");
    files.push_back({"--proof", *proof, true});
  }
  if (const auto& claim = outputs.claim_out) {
    if (*claim == "-") throw UsageError("--claim-out -: expected the name of a file");
    files.push_back({"--claim-out", *claim});
  }
  if (const auto& trajectory = request.trajectory) {
    if (*trajectory == "-") throw UsageError("--trajectory -: expected the name of a file");
    files.push_back({"--trajectory", *trajectory, true});
  }
  if (const auto& junit = outputs.junit) {
    if (*junit == "-") throw UsageError("--junit -: expected the name of a file");
    files.push_back({"--junit", *junit});
  }
  return files;
}

ExitCode exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::no_contact:
    case Verdict::proved: return ExitCode::holds;
    case Verdict::contact:
    case Verdict::too_near: return ExitCode::refuted;
    case Verdict::undecided: return ExitCode::undecided;
  }
  return ExitCode::failure;
}

ExitCode answer(VerifyWork& request, const VerdictOutputs& outputs, const Output& output) {
  request.stop = &interrupted();
  ProofRoute route(request);
  std::optional<ProgressBars> bars(std::in_place);
  const bool told = !request.run && request.frames.size() > 2 && request.reading.bodies.empty() &&
                    std::ranges::all_of(request.frames, is_frame_name);
  request.progress = [&](std::string_view work, double share) {
    bars->show(work, share, told ? where(request, work, share) : "");
  };
  const VerifyOutcome outcome = verify(request, route);
  bars.reset();
  if (outputs.claim_out && outcome.claim.cells.empty()) {
    tell_note("no claim was written: no step was looked at");
  } else if (outputs.claim_out) {
    write_file(*outputs.claim_out, to_text(claim_file(outcome.claim)));
  }
  if (outputs.junit) write_result(*outputs.junit, report::verify_junit(request, outcome));
  if (outputs.github) write_standard_output(report::verify_annotations(request, outcome));
  // The JSON of 10,000 frames takes more memory than all else.
  Json json = outputs.results.json ? report::verify_json(request, outcome) : Json::object();
  const report::TextOptions wanted{outputs.results.json.value_or(""), outputs.results.verbose};
  output.write("verify", report::verify_answer(request, outcome, wanted), std::move(json));
  return exit_code(outcome.verdict);
}

}  // namespace noli::app
