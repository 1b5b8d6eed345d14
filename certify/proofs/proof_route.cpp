// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/proof_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "certify/decided_steps.h"
#include "certify/process/hdf5_frames.h"
#include "certify/proofs/check_frames.h"
#include "certify/proofs/claim.h"
#include "certify/stopwatch.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// What the prover decides when nobody wants its proof.
class NoSink : public Sink {
  void write(std::string_view /*bytes*/) override {}
  void sync() override {}
  void truncate(std::uint64_t /*size*/) override {}
};

/// A file that only this process needs, so it is never synced to the disk.
class ScratchFile : public FileSink {
 public:
  explicit ScratchFile(const fs::path& path) : FileSink(path, Open::create) {}
  void sync() override {}
};

/// To a checker, of a proof that others have made.
class JoinedSink : public CheckerSink {
 public:
  JoinedSink(std::function<CheckerProcess&()> start, std::function<void(const std::string&)> refuse)
      : CheckerSink(std::move(start)), refuse_(std::move(refuse)) {}
  void write(std::string_view bytes) override {
    try {
      CheckerSink::write(bytes);
    } catch (const ProofRefused& refused) {
      refuse_(refused.what());
    }
  }

 private:
  std::function<void(const std::string&)> refuse_;
};

/// To a file, and on the way to a checker.
class BothSinks : public Sink {
 public:
  BothSinks(std::unique_ptr<Sink> one, std::unique_ptr<Sink> other) : sinks_{std::move(one), std::move(other)} {}
  void write(std::string_view bytes) override {
    for (const auto& sink : sinks_) sink->write(bytes);
  }
  void sync() override {
    for (const auto& sink : sinks_) sink->sync();
  }
  void truncate(std::uint64_t size) override {
    for (const auto& sink : sinks_) sink->truncate(size);
  }

 private:
  std::unique_ptr<Sink> sinks_[2];
};

}  // namespace

ProofRoute::ProofRoute(VerifyWork& request) : request_(request) {
  if ((request.lines_in_no_file || frames_are_streamed()) && request.check && request.min_distance == 0) {
    request.trajectory_pipe = &pipe_.emplace(StopOfWork(request.stop, request.deadline));
  }
  can_check_ = request.check && (pipe_.has_value() || can_be_read_again());
  file_ = request.proof;
  if (file_ && request.decided) file_ = unfinished_.emplace(*file_, Replacing{.name = ScratchName::random}).path();
  // Steps that are decided already take less time than their checker, so several checkers share them out.
  const bool joined = request.decided && !pipe_ && request.threads != 1;
  const bool later = request.min_distance > 0 || request.follow || request.live;
  if (!file_ && can_check_ && joined) file_ = folder_.emplace(request.decided->scratch()).path() / "proof.noli";
  if (!file_ && can_check_ && later) file_ = folder_.emplace().path() / "proof.noli";
  if (pipe_ && file_) {
    request.open_proof = [this](const Claim& claim) {
      return std::make_unique<BothSinks>(to_file(), to_checker(claim));
    };
  } else if (file_) {
    request.open_proof = [this](const Claim&) { return to_file(); };
  } else if (can_check_) {
    request.open_proof = [this](const Claim& claim) { return to_checker(claim); };
    request.open_proof_at_once = true;
  } else if (request.min_distance > 0) {
    request.open_proof = [](const Claim&) { return std::make_unique<NoSink>(); };
  }
}

bool ProofRoute::frames_are_streamed() const {
  if (request_.run) return false;
  return !checkers_read(request_.frames, request_.reading);
}

bool ProofRoute::can_be_read_again() const {
  if (request_.lines_in_no_file) return false;
  if (request_.reading.given) return request_.reading.given->again;
  std::error_code error;
  return std::ranges::all_of(trajectory_for_checker(request_.frames), [&](const fs::path& path) {
    return path != "-" && (!fs::exists(path, error) || fs::is_regular_file(path, error));
  });
}

std::vector<fs::path> ProofRoute::trajectory() const {
  if (pipe_) return {pipe_->path()};
  return trajectory_for_checker(request_.frames);
}

void ProofRoute::check(VerifyOutcome& outcome) {
  check_proof_of(outcome);
  if (!unfinished_) return;
  const bool cut = outcome.verdict == Verdict::undecided && (outcome.interrupted || outcome.out_of_time);
  if (!cut && fs::exists(unfinished_->path())) return unfinished_->take_name();
  outcome.proof_begun = false;
}

void ProofRoute::check_proof_of(VerifyOutcome& outcome) {
  if (request_.check) outcome.not_checked = why_not(outcome);
  const bool refuted = outcome.verdict == Verdict::contact || outcome.verdict == Verdict::too_near;
  const bool whole = outcome.verdict == Verdict::no_contact || (refuted && outcome.witnesses > 0);
  if (!request_.check || outcome.not_checked || !whole) return;
  const Stopwatch watch;
  std::optional<CheckerVerdict> verdict;
  try {
    verdict = verdict_on(outcome.claim);
  } catch (const Stopped&) {  // while the frames were read again
  }
  outcome.check_seconds = watch.seconds();
  if (!verdict) return stopped(outcome);
  outcome.checked = first_line(verdict->words);
  if (verdict->code != (refuted ? 1 : 0)) {
    refuse("the checker did not accept the proof, so one of the two is wrong: " + *outcome.checked);
  }
  require_claim(outcome.claim, verdict->words, refuted);
  if (frames_are_streamed()) {
    const char* const advice = request_.trajectory || request_.reading.given
                                   ? ""
                                   : "; noli verify --trajectory OUT writes them to a file that checkers read";
    outcome.notes.push_back(fmt::format("the checker got the frames from noli, not from files{}", advice));
  }
  outcome.checker = version_of(Checker::plain);
  if (!refuted) outcome.verdict = Verdict::proved;
}

/// Of the checker that has read along, or one that reads the file. Frames that no checker reads are read once more.
std::optional<CheckerVerdict> ProofRoute::verdict_on(const Claim& claim) {
  if (checker_) {
    if (pipe_) pipe_->close();
    return checker_->finish();
  }
  const CheckRequest request{.proof = file_,
                             .trajectory = trajectory(),
                             .asked = fields_of(claim),
                             .stop = request_.stop,
                             .deadline = request_.deadline,
                             .checkers = request_.threads};
  if (frames_are_streamed()) return check_frames(request, *open_all_frames(request_.frames, request_.reading));
  return checked(request);
}

/// Of steps that others decided, what they wrote is wrong.
void ProofRoute::refuse(const std::string& problem) const {
  if (request_.decided == nullptr) throw std::runtime_error(problem);
  std::string told = problem;
  if (unfinished_) {  // its name is gone before anybody could look for it
    const std::string name = unfinished_->path().string();
    if (const std::size_t at = told.find(name); at != std::string::npos) {
      told.replace(at, name.size(), request_.proof->string());
    }
  }
  throw InputError(request_.decided->scratch().string(), "",
                   "the shards do not match: " + told + "; make them again in a new folder");
}

/// The checker has looked at the claim that was asked, and at no other.
void ProofRoute::require_claim(const Claim& asked, const std::string& words, bool refuted) const {
  const char* const word = refuted ? "refuted" : "accepted";
  const auto checked = claim_of_words(words);
  if (!checked) refuse(fmt::format("the checker does not say which claim it {}", word));
  if (const auto other = difference(asked, *checked, refuted)) {
    refuse(fmt::format("the checker {} a different claim: {}", word, *other));
  }
}

std::unique_ptr<Sink> ProofRoute::to_file() const {
  fs::remove(*file_);
  if (folder_) return std::make_unique<ScratchFile>(*file_);
  return std::make_unique<FileSink>(*file_, FileSink::Open::create);
}

std::unique_ptr<Sink> ProofRoute::to_checker(const Claim& claim) {
  if (!can_be_asked(claim)) {
    if (pipe_) pipe_->abandon();  // nobody will read it
    return std::make_unique<NoSink>();
  }
  const CheckRequest asked{
      .trajectory = trajectory(), .asked = fields_of(claim), .stop = request_.stop, .deadline = request_.deadline};
  const auto start = [this, asked]() -> CheckerProcess& { return checker_.emplace(asked); };
  if (request_.decided == nullptr) return std::make_unique<CheckerSink>(start);
  return std::make_unique<JoinedSink>(start, [this](const std::string& problem) { refuse(problem); });
}

std::optional<std::string> ProofRoute::why_not(const VerifyOutcome& outcome) const {
  if (!can_check_ && request_.lines_in_no_file)
    return "the run recorded only frames, but a proof of a least distance needs world lines in a file";
  if (!can_check_) return "standard input, pipes and generators cannot be read a second time";
  if (!can_be_asked(outcome.claim)) return "more pairs of cells are left out than a checker can be asked about";
  if (outcome.no_proof) return "no proof was found";
  if (outcome.verdict == Verdict::contact && outcome.near)
    return "the proof ends where something is, or may be, too near before it touches";
  if (outcome.open_window && !pipe_)
    return "the run ends within a window; resume it first (noli simulate ... --resume)";
  return std::nullopt;
}

void ProofRoute::stopped(VerifyOutcome& outcome) const {
  const bool by_user = request_.stop != nullptr && request_.stop->load(std::memory_order_relaxed);
  (by_user ? outcome.interrupted : outcome.out_of_time) = true;
  outcome.not_checked = by_user ? "interrupted" : "time limit";
  if (outcome.verdict != Verdict::no_contact) return;
  outcome.verdict = Verdict::undecided;
  outcome.complete = false;
}

}  // namespace noli
