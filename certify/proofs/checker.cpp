// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/checker.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "certify/process/run_program.h"
#include "certify/process/start_process.h"
#include "certify/process/this_program.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

const char* name_of(Checker checker) { return checker == Checker::plain ? "noli_check" : "noli_check_verified"; }

/// The name - is standard input's, and others that begin so are options.
std::string name_of_file(const fs::path& path) {
  return path.string().starts_with('-') ? "./" + path.string() : path.string();
}

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

}  // namespace

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

CheckerProcess::CheckerProcess(const CheckRequest& request)
    : checker_(request.checker), words_(std::make_unique<Pipe>()), stop_(request.stop) {
  const std::string name = name_of(checker_);
  std::vector<std::string> arguments = {
      (request.programs.empty() ? beside_this_program(name) : request.programs / name).string()};
  for (const std::string& field : request.asked) arguments.insert(arguments.end(), {"--require", field});
  arguments.push_back(request.proof ? name_of_file(*request.proof) : "-");
  for (const fs::path& path : request.trajectory) arguments.push_back(name_of_file(path));
  if (!request.proof) {
    proof_ = std::make_unique<Pipe>();
    proof_->never_wait(1);
  }
  words_->never_wait(0);
  std::vector<GivenDescriptor> descriptors = {{STDOUT_FILENO, words_->end(1)}};
  if (proof_) descriptors.push_back({STDIN_FILENO, proof_->end(0)});
  pid_ = start_process(std::move(arguments), descriptors);
  words_->close(1);
  if (proof_) proof_->close(0);
}

CheckerProcess::~CheckerProcess() { end_it(); }

void CheckerProcess::end_it() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);  // and whatever it may have started
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

bool CheckerProcess::stopped() const {
  return stop_asked().has_value() || (stop_ != nullptr && stop_->load(std::memory_order_relaxed));
}

bool CheckerProcess::ready(int end, short event) const {
  constexpr int milliseconds = 100;  // an interruption that came before poll() does not end it
  for (;;) {
    if (stopped()) return false;
    pollfd one{end, event, 0};
    const int there = ::poll(&one, 1, milliseconds);
    if (there > 0) return true;
    if (there < 0 && errno != EINTR) fail("waiting for the checker");
  }
}

void CheckerProcess::write(std::string_view bytes) {
  while (!bytes.empty() && proof_->end(1) >= 0) {
    const ssize_t written = ::write(proof_->end(1), bytes.data(), bytes.size());
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN && errno != EPIPE) fail("the proof on its way to the checker");
    if (errno == EPIPE)
      throw std::runtime_error(fmt::format("{} reads no more of the proof{}", name_of(checker_), why()));
    if (!ready(proof_->end(1), POLLOUT)) proof_->close(1);
  }
}

/// What it said before it ended, if anything.
std::string CheckerProcess::why() {
  try {
    const auto verdict = finish();
    return verdict ? ": " + first_line(verdict->words) : "";
  } catch (const std::runtime_error& error) {
    return std::string(": ") + error.what();
  }
}

std::optional<CheckerVerdict> CheckerProcess::finish() {
  if (proof_) proof_->close(1);
  CheckerVerdict verdict;
  for (std::array<char, 65536> part;;) {
    if (!ready(words_->end(0), POLLIN)) {
      end_it();
      return std::nullopt;
    }
    const ssize_t got = ::read(words_->end(0), part.data(), part.size());
    if (got > 0) take_words(verdict.words, {part.data(), static_cast<std::size_t>(got)});
    if (got == 0) break;
    if (got < 0 && errno != EINTR && errno != EAGAIN) fail("the checker's words");
  }
  const std::optional<int> status = wait_for_end(pid_, time_to_stay, [this] { return stopped(); });
  if (!status) {
    end_it();
    if (stopped()) return std::nullopt;
    throw std::runtime_error(fmt::format("{} closed its output, but did not end", name_of(checker_)));
  }
  pid_ = -1;
  if (WIFSIGNALED(*status)) {
    const char* const why = WTERMSIG(*status) == SIGKILL ? ", as when memory runs out" : "";
    throw HelperError(fmt::format("{} was ended by signal {}{}", name_of(checker_), WTERMSIG(*status), why));
  }
  verdict.code = WEXITSTATUS(*status);
  constexpr int machine_failed = 4;
  if (verdict.code == machine_failed) {
    throw HelperError(fmt::format("{} {}", name_of(checker_), first_line(verdict.words)));
  }
  if (verdict.code != 0 && verdict.code != 1 && verdict.code != 3) {
    throw std::runtime_error(fmt::format("{} ended with code {}; expected 0, 1 or 3", name_of(checker_), verdict.code));
  }
  const char* const first = verdict.code == 0 ? "accepted: " : verdict.code == 1 ? "refuted: " : "rejected: ";
  if (!verdict.words.starts_with(first)) {
    throw std::runtime_error(
        fmt::format("{} ended with code {}, but does not say so", name_of(checker_), verdict.code));
  }
  return verdict;
}

CheckerVerdict check_proof(const CheckRequest& request) {
  auto verdict = CheckerProcess(request).finish();
  if (!verdict) throw Stopped(stop_asked().value_or(StopReason::interrupted), request.proof->string());
  return *std::move(verdict);
}

std::vector<fs::path> trajectory_for_checker(const std::vector<fs::path>& trajectory) {
  if (trajectory.size() == 1 && fs::is_directory(trajectory[0])) return {trajectory_path(trajectory[0])};
  return trajectory;
}

}  // namespace noli
