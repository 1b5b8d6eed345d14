// SPDX-License-Identifier: Apache-2.0
//
// Runs the checkers of proofs (proofs/checker, proofs/coq) as separate processes.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <noli/proof.h>
#include "certify/process/child.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/stop.h"

namespace noli {

/// Whether the checker was built with this program.
bool has_checker(Checker checker);

/// A checker ended with a verdict before it had read all of the proof.
struct ProofRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A running checker. It does not get the signals of the terminal: this process gets them and ends it. The destructor
/// ends it if it has not ended.
class CheckerProcess {
 public:
  /// Starts it. Throws UsageError when there is no verified checker, std::runtime_error when there is no plain one.
  explicit CheckerProcess(const CheckRequest& request);
  CheckerProcess(const CheckerProcess&) = delete;
  CheckerProcess& operator=(const CheckerProcess&) = delete;

  /// Writes the next bytes of the proof. After a stop nothing more is written; finish() then returns nothing. Throws
  /// ProofRefused when the checker stops reading with a verdict, otherwise what finish() throws.
  void write(std::string_view bytes);
  /// Waits until it has read everything and has ended. After a stop, even one during write(), returns nothing unless
  /// the checker has refuted something: any other verdict may leave out the end of the motion. Throws HelperError when
  /// the machine failed it (memory, a signal); std::runtime_error when it ended with an unexpected exit code, or closed
  /// its output and stayed.
  std::optional<CheckerVerdict> finish();

 private:
  static std::vector<std::string> command(const CheckRequest& request);
  void tell_progress() const;
  void end_early();

  Checker checker_;
  StopOfWork stop_;
  std::optional<std::filesystem::path> proof_;
  std::function<void(double)> progress_;
  ProgramLimits limits_;
  bool cut_ = false;  ///< something was not written, after a stop
  Child child_;
};

/// The verdict on a proof in a file, of one checker or of several. Nothing after a stop. Precondition: request.proof.
/// Throws as CheckerProcess.
std::optional<CheckerVerdict> checked(const CheckRequest& request);

/// Returns the verdict. Without one, throws Stopped: with the reason of the stop, else out_of_time if request.deadline
/// has passed, else interrupted. Precondition: request.proof.
CheckerVerdict verdict_or_stopped(std::optional<CheckerVerdict> verdict, const CheckRequest& request);

/// Writes a proof to a running checker.
class CheckerSink : public Sink {
 public:
  /// `start`: starts a checker in place of the last one, and returns it; it must live until the next call.
  explicit CheckerSink(std::function<CheckerProcess&()> start) : start_(std::move(start)), checker_(&start_()) {}
  void write(std::string_view bytes) override;
  void sync() override;
  /// Bytes that were written cannot be taken back. If all but the first group is cut off, the next write() starts
  /// another checker with that group. Otherwise the checker would reject the proof; its verdict is not used then.
  void truncate(std::uint64_t size) override;

 private:
  std::function<CheckerProcess&()> start_;
  CheckerProcess* checker_;
  std::string first_group_;  ///< with what is before it
  int syncs_ = 0;            ///< up to the end of the first group, which two of them commit
  bool again_ = false;       ///< another checker has to be started
};

}  // namespace noli
