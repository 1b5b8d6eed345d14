// SPDX-License-Identifier: Apache-2.0
#include "certify/series/ending.h"

#include <unistd.h>

#include <cstring>

namespace noli::series {
namespace {

/// Nothing is left to do when not even this can be written.
void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

void end_with(Ending ending, std::string_view line) {
  say(line);
  say("\n");
  ::_exit(static_cast<int>(ending));
}

void end_lost(int error) { end_with(Ending::failure, ::strerror(error)); }

}  // namespace noli::series
