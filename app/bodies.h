// SPDX-License-Identifier: Apache-2.0
//
// --body and --obstacle: several bodies, each with files of its own.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <noli/frames.h>

namespace noli::app {

/// What the user wrote.
struct BodyArguments {
  std::vector<std::string> bodies, obstacles;

  bool any() const { return !bodies.empty() || !obstacles.empty(); }
};

/// `frames`: the option that names frames of one mesh, which goes with neither; nullptr for a command without it.
void add_body_options(CLI::App& command, BodyArguments& arguments, CLI::Option* frames);

/// The bodies with their files, each in the order that is asked for. Notes on the order are added to `notes`. Throws
/// UsageError, InputError.
std::vector<BodyFrames> bodies_of(const BodyArguments& arguments, FrameOrder order, std::vector<std::string>& notes);

}  // namespace noli::app
