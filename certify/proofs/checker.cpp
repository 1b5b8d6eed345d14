// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/checker.h"

#include <fmt/format.h>

#include <csignal>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "certify/process/run_program.h"
#include "certify/process/this_program.h"
#include "certify/proofs/check_parts.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

const char* name_of(Checker checker) { return checker == Checker::plain ? "noli_check" : "noli_check_verified"; }

/// The name - means standard input, and other names that begin with - are options.
std::string name_of_file(const fs::path& path) {
  return path.string().starts_with('-') ? "./" + path.string() : path.string();
}

}  // namespace

bool has_checker(Checker checker) {
  std::error_code error;
  return fs::exists(beside_this_program(name_of(checker)), error);
}

CheckerVersion version_of(Checker checker) {
  ProgramLimits limits;
  limits.time = std::chrono::seconds(10);
  const std::string name = name_of(checker);
  const ProgramEnd end = run_program({beside_this_program(name).string(), "--version"}, limits);
  std::istringstream words(end.out);
  CheckerVersion said;
  if (!end.exited_with(0) || !(words >> said.name >> said.version >> said.commit)) {
    throw HelperError(name + " does not say its version; expected the program that was built with this noli");
  }
  return said;
}

std::vector<std::string> CheckerProcess::command(const CheckRequest& request) {
  const std::string name = name_of(request.checker);
  if (request.programs.empty() && request.checker == Checker::verified && !has_checker(Checker::verified)) {
    throw UsageError(
        "this noli was built without the verified checker; install ocaml-findlib and libzarith-ocaml-dev, and build "
        "again");
  }
  std::vector<std::string> words = {
      (request.programs.empty() ? beside_this_program(name) : request.programs / name).string()};
  for (const std::string& field : request.asked) words.insert(words.end(), {"--require", field});
  words.push_back(request.proof ? name_of_file(*request.proof) : "-");
  for (const fs::path& path : request.trajectory) words.push_back(name_of_file(path));
  return words;
}

CheckerProcess::CheckerProcess(const CheckRequest& request)
    : checker_(request.checker),
      stop_(request.stop, request.deadline),
      proof_(request.proof),
      progress_(request.progress),
      limits_{.time = no_limit,
              .stop =
                  [this] {
                    tell_progress();
                    return stop_.is_asked();
                  },
              .to_end = {}},
      child_(command(request),
             {.in = request.proof ? Child::shared : Child::piped, .out = Child::piped, .err = Child::shared}) {}

void CheckerProcess::tell_progress() const {
  if (!progress_ || !proof_) return;
  if (const auto share = child_.share_read(*proof_)) progress_(*share);
}

void CheckerProcess::write(std::string_view bytes) {
  if (stop_.is_asked()) cut_ = true;
  if (cut_) return;
  const Child::Written written = child_.write(bytes, limits_);
  cut_ = written == Child::Written::stopped;
  if (written == Child::Written::refused) end_early();
}

/// It reads no more. Without a verdict a stop came before its end.
void CheckerProcess::end_early() {
  const auto verdict = finish();
  if (verdict) {
    throw ProofRefused(fmt::format("{} stopped reading the proof: {}", name_of(checker_), first_line(verdict->words)));
  }
  cut_ = true;
}

std::optional<CheckerVerdict> CheckerProcess::finish() {
  if (cut_) return std::nullopt;  // it did not get all of the proof; the destructor ends it
  ProgramEnd end = child_.finish(limits_);
  switch (end.kind) {
    case ProgramEnd::Kind::exited: break;
    case ProgramEnd::Kind::stopped: return std::nullopt;
    case ProgramEnd::Kind::hung:
      throw std::runtime_error(fmt::format("{} closed its output, but did not end", name_of(checker_)));
    case ProgramEnd::Kind::signalled:
      const char* const why = end.code == SIGKILL ? ", perhaps out of memory" : "";
      throw HelperError(fmt::format("{} was ended by signal {}{}", name_of(checker_), end.code, why));
  }
  // After a stop a motion on a pipe ends early, so only a refutation still counts.
  constexpr int refuted = 1, machine_failed = 4;
  if (end.code != refuted && stop_.is_asked()) return std::nullopt;
  if (end.code == machine_failed) throw HelperError(fmt::format("{} {}", name_of(checker_), first_line(end.out)));
  if (end.code != 0 && end.code != refuted && end.code != 3) {
    throw std::runtime_error(fmt::format("{} ended with code {}; expected 0, 1 or 3", name_of(checker_), end.code));
  }
  const char* const first = end.code == 0 ? "accepted: " : end.code == refuted ? "refuted: " : "rejected: ";
  if (!end.out.starts_with(first)) {
    throw std::runtime_error(fmt::format("{} ended with code {}, but does not say so", name_of(checker_), end.code));
  }
  return CheckerVerdict{end.code, std::move(end.out)};
}

void CheckerSink::write(std::string_view bytes) {
  if (std::exchange(again_, false)) {
    checker_ = &start_();
    checker_->write(first_group_);
  }
  if (syncs_ < 2) first_group_ += bytes;
  checker_->write(bytes);
}

void CheckerSink::sync() {
  if (syncs_ < 2) ++syncs_;
}

void CheckerSink::truncate(std::uint64_t size) { again_ = size == first_group_.size(); }

std::optional<CheckerVerdict> checked(const CheckRequest& request) {
  if (auto accepted = accepted_in_parts(request)) return accepted;
  return CheckerProcess(request).finish();
}

CheckerVerdict check_proof(const CheckRequest& request) { return verdict_or_stopped(checked(request), request); }

CheckerVerdict verdict_or_stopped(std::optional<CheckerVerdict> verdict, const CheckRequest& request) {
  if (verdict) return *std::move(verdict);
  const bool late = request.deadline && std::chrono::steady_clock::now() >= *request.deadline;
  const StopReason otherwise = late ? StopReason::out_of_time : StopReason::interrupted;
  throw Stopped(stop_asked().value_or(otherwise), request.proof->string());
}

std::vector<fs::path> trajectory_for_checker(const std::vector<fs::path>& trajectory) {
  if (trajectory.size() == 1 && fs::is_directory(trajectory[0])) return {trajectory_path(trajectory[0])};
  return trajectory;
}

}  // namespace noli
