// SPDX-License-Identifier: Apache-2.0
#include "app/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "certify/ranks/ranks.h"

namespace noli::app {

bool has_colour(int descriptor) {
  const char* const refused = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  if (refused != nullptr && *refused != '\0') return false;
  // mpirun gives its ranks a terminal each, also when its own output goes to a file.
  if (Ranks::is_mpi_job()) return false;
  return terminal != nullptr && std::string_view(terminal) != "dumb" && ::isatty(descriptor) == 1;
}

std::string inked(std::string_view text, Ink ink, int descriptor) {
  if (!has_colour(descriptor)) return std::string(text);
  const int code = ink == Ink::red ? 31 : ink == Ink::yellow ? 33 : ink == Ink::green ? 32 : 36;
  return fmt::format("\x1b[1;{}m{}\x1b[0m", code, text);
}

}  // namespace noli::app
