// SPDX-License-Identifier: Apache-2.0
//
// Ends noli_series: one line on standard error, and an exit code as noli's. It ends at once without closing anything,
// because HDF5 writes its buffers when it is closed.
#pragma once

#include <unistd.h>

#include <cstring>
#include <string_view>

namespace noli::series {

enum class Ending : int {
  written = 0,
  bad_input = 3,  ///< the stream breaks stream.h, or the file is not as it must be
  failure = 4     ///< the machine, or HDF5
};

[[noreturn]] inline void end_with(Ending ending, std::string_view line) {
  for (const std::string_view text : {line, std::string_view("\n")}) {
    // If even this cannot be written, there is nothing left to do.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  }
  ::_exit(static_cast<int>(ending));
}
/// Ends because of the machine, with the message for errno.
[[noreturn]] inline void end_lost(int error) { end_with(Ending::failure, ::strerror(error)); }

}  // namespace noli::series
