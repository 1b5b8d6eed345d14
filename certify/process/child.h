// SPDX-License-Identifier: Apache-2.0
//
// A program that this process starts and watches to its end: the checkers of proofs, the hosts of somebody else's
// library, noli_series, and `noli` itself where it is audited.
//
// A limit of time counts the time in which this process looks. While it was stopped itself, or the machine slept, a
// second passes at most.
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

/// What is kept of the output of a program, and of its errors.
constexpr std::size_t most_words = std::size_t{1} << 20;  ///< bytes

/// How long a program may stay once it has closed its output. It has freed its memory by then.
constexpr std::chrono::seconds time_to_stay{2};

/// What a program has to clean up after itself when it is asked to end.
constexpr std::chrono::seconds time_to_end{3};

constexpr std::chrono::nanoseconds no_limit = std::chrono::nanoseconds::max();

struct ProgramLimits {
  std::chrono::nanoseconds time{std::chrono::seconds(60)};  ///< then it hangs, and is ended
  std::function<bool()> stop = [] { return false; };        ///< asked again and again; when true it is ended
  /// How long it may take to end when it is asked to. Zero: it is not asked. It may end its own programs meanwhile, and
  /// remove what it has written.
  std::chrono::milliseconds to_end = time_to_end;
};

/// For ProgramLimits::stop: whether this flag is set. Null: never.
std::function<bool()> stop_by(const std::atomic<bool>* flag);

/// How a program ended.
struct ProgramEnd {
  enum class Kind { exited, signalled, hung, stopped } kind = Kind::exited;
  int code = -1;         ///< the exit code, or the signal; -1 of one that was ended
  std::string out, err;  ///< what was read of it: at most most_words of each, then a note
  double seconds = 0;    ///< from its start to its end, by the wall clock

  bool exited_with(int expected) const { return kind == Kind::exited && code == expected; }
  /// "exit code 3", "signal 11 (Segmentation fault)", "no end within its limit of time", "stopped".
  std::string words() const;
  /// "exit 3", "signal 11", "no end after 20 s", "stopped".
  std::string brief() const;
};

/// Throws std::system_error, as Child does, when this is no program that can be started.
void require_startable(const std::string& program);

/// Counts down a limit of time.
class Patience {
 public:
  explicit Patience(std::chrono::nanoseconds limit) : left_(limit) {}
  bool is_over();

 private:
  std::chrono::nanoseconds left_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// A descriptor, closed with this.
class Descriptor {
 public:
  Descriptor() = default;
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return descriptor_; }  ///< -1 once it is closed
  void take(int descriptor);
  void close() { take(-1); }

 private:
  int descriptor_ = -1;
};

/// A program at work. It is in a group of processes of its own, so it does not share the signals of the terminal. The
/// group ends with it, and with this.
class Child {
 public:
  /// What it has as a descriptor, if not one of ours: /dev/null; the one that this process has; a pipe to this.
  static constexpr int nothing = -1, shared = -2, piped = -3;
  struct Descriptors {
    int in = nothing, out = nothing, err = nothing;
    int third = shared;  ///< descriptor 3, which others than ours do not reach
  };

  /// words[0] is the program, the rest its arguments. Throws std::system_error when it is not there, or the machine has
  /// no process or descriptor left.
  Child(std::vector<std::string> words, const Descriptors& given);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  enum class Written { all, refused, stopped, late };
  /// Writes to its input, and reads what it says meanwhile. `limits.time`: for which it may take nothing. `refused`: it
  /// reads no more. Throws std::system_error.
  Written write(std::string_view bytes, const ProgramLimits& limits);
  /// The next bytes of its output, no more than it may say in all; nothing when it ends or its time is up before
  /// (silent() tells).
  std::optional<std::string> read(std::size_t count, const ProgramLimits& limits);
  /// Closes its input, reads the rest, and waits for its end; ends it at a limit, or when it has closed its output and
  /// does not end within time_to_stay. Precondition: its output or its errors are piped.
  ProgramEnd finish(const ProgramLimits& limits);

  // For who has limits of their own:

  /// Waits for something to read, at most for this long, and reads it. `to_write`: for room to write, too.
  void look(std::chrono::nanoseconds pause, bool to_write = false);
  /// Whether it has closed its output and its errors.
  bool silent() const { return pipes_[1].get() < 0 && pipes_[2].get() < 0; }
  bool has_ended() const;
  /// Ends it if it has not ended; once. Throws std::system_error if somebody else in this process has waited for it.
  ProgramEnd end(ProgramEnd::Kind why, std::chrono::milliseconds patience);
  /// What it has computed so far, all its threads together.
  std::chrono::nanoseconds computed() const;
  std::uint64_t resident_bytes() const;

  std::string out, err;  ///< what was read and not taken away yet

 private:
  bool take(std::size_t pipe);
  std::optional<int> end_it(std::chrono::milliseconds patience);

  std::array<Descriptor, 3> pipes_;  ///< our ends
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  pid_t pid_ = -1;
};

}  // namespace noli
