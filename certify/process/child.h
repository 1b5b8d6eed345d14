// SPDX-License-Identifier: Apache-2.0
//
// Starts a program and watches it until it ends: the checkers of proofs, the hosts of other people's libraries,
// noli_series, and `noli` itself when it is audited.
//
// A time limit counts the time in which this process watches. While this process is stopped, or the machine sleeps, at
// most a second counts.
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

/// How much is kept of a program's output, and of its errors.
constexpr std::size_t most_output = std::size_t{1} << 20;  ///< bytes

/// How long a program may stay after closing its output. It has freed its memory by then.
constexpr std::chrono::seconds time_to_stay{2};

/// How long a program may clean up after it is asked to end.
constexpr std::chrono::seconds time_to_end{3};

constexpr std::chrono::nanoseconds no_limit = std::chrono::nanoseconds::max();

struct ProgramLimits {
  std::chrono::nanoseconds time{std::chrono::seconds(60)};  ///< after this it counts as hung, and is ended
  std::function<bool()> stop = [] { return false; };        ///< polled; when it returns true, the program is ended
  /// How long it may take to end after it is asked to, for example to end its own programs and remove its files. Zero:
  /// it is not asked.
  std::chrono::milliseconds to_end = time_to_end;
};

/// For ProgramLimits::stop: whether this flag is set. Null: never.
std::function<bool()> stop_by(const std::atomic<bool>* flag);

/// How a program ended.
struct ProgramEnd {
  enum class Kind { exited, signalled, hung, stopped } kind = Kind::exited;
  int code = -1;         ///< the exit code, or the signal; -1 if it was ended
  std::string out, err;  ///< its output and errors: at most most_output of each, then a note
  double seconds = 0;    ///< from its start to its end, by the wall clock

  bool exited_with(int expected) const { return kind == Kind::exited && code == expected; }
  /// "exit code 3", "signal 11 (Segmentation fault)", "no end within the time limit", "stopped".
  std::string words() const;
  /// "exit 3", "signal 11", "no end after 20 s", "stopped".
  std::string brief() const;
};

/// Throws std::system_error, as Child does, when this is not a program that can be started.
void require_startable(const std::string& program);

/// write(2) to a pipe. Where the other end is closed it fails with EPIPE, and raises no SIGPIPE, which would end the
/// program that this library is part of.
ssize_t write_to_pipe(int descriptor, std::string_view bytes);

/// Counts down a time limit.
class Patience {
 public:
  explicit Patience(std::chrono::nanoseconds limit) : left_(limit) {}
  bool is_over();

 private:
  std::chrono::nanoseconds left_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// A descriptor, closed by the destructor.
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

/// A running program. It has a process group of its own, so it does not get the signals of the terminal. The group ends
/// when the program ends or this object is destroyed.
class Child {
 public:
  /// Values for a descriptor other than one of ours: /dev/null; the same as in this process; a pipe to this process.
  static constexpr int nothing = -1, shared = -2, piped = -3;
  struct Descriptors {
    int in = nothing, out = nothing, err = nothing;
    int third = shared;  ///< descriptor 3; if shared, it exists only in programs that were given one
  };

  /// words[0] is the program, the rest its arguments. Throws std::system_error when there is no such program, or the
  /// machine has no process or descriptor left.
  Child(std::vector<std::string> words, const Descriptors& given);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  enum class Written { all, refused, stopped, late };
  /// Writes to its input, and reads its output meanwhile. `limits.time`: how long it may read nothing. `refused`: it
  /// stopped reading. Throws std::system_error.
  Written write(std::string_view bytes, const ProgramLimits& limits);
  /// The next `count` bytes of its output. Nothing if it is silent(), is stopped or runs out of time before.
  /// Precondition: count <= most_output.
  std::optional<std::string> read(std::size_t count, const ProgramLimits& limits);
  /// Closes its input, reads the rest, and waits until it ends. Ends it at a limit, or if it has closed its output and
  /// does not end within time_to_stay. Precondition: its output or its errors are piped.
  ProgramEnd finish(const ProgramLimits& limits);

  // For callers with limits of their own:

  /// Waits for something to read, at most for this long, and reads it. `to_write`: also waits for room to write.
  void look(std::chrono::nanoseconds pause, bool to_write = false);
  /// Whether it has closed its output and its errors.
  bool silent() const { return pipes_[1].get() < 0 && pipes_[2].get() < 0; }
  bool has_ended() const;
  /// Ends it if it has not ended. Call it once. Throws std::system_error if other code in this process has waited for
  /// it.
  ProgramEnd end(ProgramEnd::Kind why, std::chrono::milliseconds patience);
  /// The processor time of all its threads so far.
  std::chrono::nanoseconds computed() const;
  std::uint64_t resident_bytes() const;
  /// The share of a file that it has read, in [0, 1]: where it is in it. Nothing if it does not have the file open.
  std::optional<double> share_read(const std::filesystem::path& file) const;

  std::string out, err;  ///< what was read and not taken yet

 private:
  bool take(std::size_t pipe);
  std::optional<int> end_it(std::chrono::milliseconds patience);

  std::array<Descriptor, 3> pipes_;  ///< our ends
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  pid_t pid_ = -1;
};

}  // namespace noli
