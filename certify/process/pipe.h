// SPDX-License-Identifier: Apache-2.0
//
// A pipe to or from a program that is started (certify/process/start_process.h).
#pragma once

#include <array>
#include <cstddef>

namespace noli {

/// Both ends, 0 to read from and 1 to write to, are closed with it, and by every program that is started.
class Pipe {
 public:
  /// Throws std::system_error, here and below.
  Pipe();
  ~Pipe();
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  /// -1 once it is closed.
  int end(std::size_t i) const { return ends_[i]; }
  void close(std::size_t i);
  /// Who uses this end asks before whether it would have to wait.
  void never_wait(std::size_t i) const;

 private:
  std::array<int, 2> ends_{-1, -1};
};

}  // namespace noli
