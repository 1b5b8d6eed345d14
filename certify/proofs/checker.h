// SPDX-License-Identifier: Apache-2.0
//
// The checkers of proofs, which are programs of their own (proofs/checker, proofs/coq), run as separate processes.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <noli/proof.h>
#include "certify/process/child.h"
#include "trajectory/blocks/block_sink.h"

namespace noli {

/// A checker at work. It does not share the signals of the terminal: this process hears them, and ends it. Ended with
/// this if it has not ended.
class CheckerProcess {
 public:
  /// Starts it. Throws std::runtime_error when the checker is not there.
  explicit CheckerProcess(const CheckRequest& request);
  CheckerProcess(const CheckerProcess&) = delete;
  CheckerProcess& operator=(const CheckerProcess&) = delete;

  /// The next bytes of the proof. Nothing is written any more after a stop; finish() tells.
  /// Throws std::runtime_error when the checker reads no more.
  void write(std::string_view bytes);
  /// Waits until it has read all that was written and has ended; nothing after a stop, also
  /// one that came while it was written to: what it says is then not about all of the proof. Throws
  /// HelperError when the machine failed it (memory, a signal); std::runtime_error when it ended with another code than
  /// it may, or closed its output and stayed.
  std::optional<CheckerVerdict> finish();

 private:
  static std::vector<std::string> command(const CheckRequest& request);
  bool stopped() const;
  std::string why();

  Checker checker_;
  const std::atomic<bool>* stop_;
  ProgramLimits limits_;
  bool cut_ = false;  ///< something was not written, after a stop
  Child child_;
};

/// Writes a proof to a checker that is at work, which has to outlive it.
class CheckerSink : public Sink {
 public:
  explicit CheckerSink(CheckerProcess& checker) : checker_(checker) {}
  void write(std::string_view bytes) override { checker_.write(bytes); }
  void sync() override {}
  /// What was written cannot be taken back: the checker will reject a proof of which a part was to be cut off. Nobody
  /// asks it then.
  void truncate(std::uint64_t /*size*/) override {}

 private:
  CheckerProcess& checker_;
};

}  // namespace noli
