// SPDX-License-Identifier: Apache-2.0
//
// What every reader throws: the file, the place in it, and what was expected there.
#pragma once

#include <stdexcept>
#include <string>

namespace noli {

/// Bad input. what() is one line: "FILE:PLACE: what is wrong, and what was expected". PLACE is "line N" for text, "byte
/// N" for binary content, and absent where the file as a whole is meant (missing, empty).
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& place, const std::string& problem)
      : std::runtime_error(place.empty() ? file + ": " + problem : file + ": " + place + ": " + problem) {}
};

}  // namespace noli
