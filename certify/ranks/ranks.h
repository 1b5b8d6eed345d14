// SPDX-License-Identifier: Apache-2.0
//
// The ranks of a job that mpirun started: which one this is, and the tasks that they share out.
//
//   if (const auto ranks = Ranks::of_this_job()) ...
//
// noli_mpi.so (mpi_library.h) is loaded only in such a job, so that nothing else needs MPI. A rank that ends
// without end() ends the whole job, with its exit code: finished tasks are on disk, and the same command does the rest.
// A process has at most one `Ranks`, and calls its functions one at a time, except where a function says otherwise.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace noli {

class Ranks {
 public:
  /// Nothing if mpirun did not start this process, or started one alone. Throws UsageError when the library is missing
  /// or does not fit, or when not all ranks are the same program; std::runtime_error when MPI fails.
  static std::unique_ptr<Ranks> of_this_job();
  /// Whether mpirun started this process as one of several. Not with NOLI_MPI=0 in the environment, for a process that
  /// one of the ranks starts.
  static bool started_by_mpirun();
  /// The same, or as the only one.
  static bool is_mpi_job();
  /// Whether noli_mpi.so is beside this program, or where it is installed.
  static bool has_library();

  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }
  /// Of the threads of this machine, this rank's share.
  int threads() const;

  /// The next task that no rank has taken; nothing once the counter is closed.
  std::optional<std::uint64_t> next_task();
  /// Answers other ranks that take tasks from the counter, now and then. From any thread, while no other function is
  /// called.
  void serve();
  /// No rank gets a task from now on.
  void close_counter();
  /// Whether a rank has closed it.
  bool counter_is_closed();
  /// The texts of all ranks, in their order, for the first one; nothing for the others. Throws std::runtime_error when
  /// they are too long.
  std::vector<std::string> gather(const std::string& text);
  /// Waits until all ranks are here.
  void barrier();
  /// The same, then ends MPI. `code`: the exit code of this rank. Returns that of the first rank, in all of them.
  int end(int code);

 private:
  struct Library;
  explicit Ranks(std::unique_ptr<Library> library);

  std::unique_ptr<Library> library_;
  int rank_ = 0, size_ = 1, on_this_machine_ = 1;
  std::chrono::steady_clock::time_point served_ = {};
};

}  // namespace noli
