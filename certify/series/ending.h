// SPDX-License-Identifier: Apache-2.0
//
// How noli_series ends: one line on standard error, and an exit code as noli's. It ends where it is: nothing is closed,
// because HDF5 writes what it still has when it is closed.
#pragma once

#include <string_view>

namespace noli::series {

enum class Ending : int {
  written = 0,
  bad_stream = 3,  ///< the stream is not as stream.h says
  failure = 4      ///< the machine, or HDF5
};

[[noreturn]] void end_with(Ending ending, std::string_view line);
/// Of the machine: what errno means.
[[noreturn]] void end_lost(int error);

}  // namespace noli::series
