// SPDX-License-Identifier: Apache-2.0
//
// What every reader throws: the file, the place in it, and what was expected there.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "trajectory/stop.h"

namespace noli {

/// The text on one line: control characters, which names of files may contain, as \n, \t or \x1b. All else stays.
std::string on_one_line(std::string_view text);

/// Bad input. what() is one line: "FILE:PLACE: what is wrong, and what was expected". PLACE is "line N" for text, "byte
/// N" for binary content, and absent where the file as a whole is meant (missing, empty).
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& place, const std::string& problem)
      : std::runtime_error(on_one_line(place.empty() ? file + ": " + problem : file + ": " + place + ": " + problem)) {}
};

/// The process was asked to stop (trajectory/stop.h) while a reader read its file or waited for it, a pipe for example.
/// what() is one line.
class ReadInterrupted : public Stopped {
 public:
  explicit ReadInterrupted(const std::string& file)
      : ReadInterrupted(file, stop_asked().value_or(StopReason::interrupted)) {}

 private:
  ReadInterrupted(const std::string& file, StopReason reason)
      : Stopped(reason, Words{on_one_line(file + (reason == StopReason::interrupted
                                                      ? ": interrupted while it was read"
                                                      : ": the time limit has passed while it was read"))}) {}
};

}  // namespace noli
