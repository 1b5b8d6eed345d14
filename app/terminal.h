// SPDX-License-Identifier: Apache-2.0
//
// What a terminal shows otherwise than a file: colour. Never where NO_COLOR is set (no-color.org) or TERM is "dumb",
// and never in a job of mpirun.
#pragma once

#include <string>
#include <string_view>

namespace noli::app {

/// Whether what is written to this descriptor may have colour.
bool has_colour(int descriptor);

/// The text in bold and red, yellow, green or cyan; as it is where there is no colour.
enum class Ink { red, yellow, green, cyan };
std::string inked(std::string_view text, Ink ink, int descriptor);

}  // namespace noli::app
