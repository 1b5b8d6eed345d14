// SPDX-License-Identifier: Apache-2.0
//
// The exceptions that Noli throws.
//
//   try {
//     const noli::VerifyOutcome outcome = noli::run_verify(request);
//   } catch (const noli::InputError& error) {      // a file is at fault: "cloth_3.obj: line 17: ..."
//   } catch (const noli::UsageError& error) {      // the request is at fault
//   }
//
// All derive from std::runtime_error, and what() is one line. Noli also throws std::system_error (disk, processes),
// std::bad_alloc, std::runtime_error (a checker is missing or failed) and, where a header says so, std::logic_error and
// what derives from it; it passes on what a callback throws. A verdict is a result, never an exception. Thread safety:
// any thread.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace noli {

/// The text on one line: control characters, which file names may contain, are escaped as \n, \t or \x1b.
std::string on_one_line(std::string_view text);

/// Bad input. what() is "FILE:PLACE: what is wrong, and what was expected". PLACE is "line N" for text, "byte N" for
/// binary content, and absent when the file as a whole is meant (missing, empty).
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& place, const std::string& problem)
      : std::runtime_error(on_one_line(place.empty() ? file + ": " + problem : file + ": " + place + ": " + problem)) {}
  /// The same error, with what to do about it.
  InputError(const InputError& error, const std::string& advice) : std::runtime_error(error.what() + ("; " + advice)) {}
};

/// A frame has another mesh than those before it: thrown by what reads frames of one mesh.
struct OtherMesh : InputError {
  using InputError::InputError;
};

/// The request is at fault: options that do not go together, a place that cannot be written to.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Results could not be written.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A helper process could not do its work, because of memory or files.
struct HelperError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class StopReason : std::uint8_t { interrupted = 1, out_of_time = 2 };

/// Work stopped early because of a request to stop or the time limit. what() is "PLACE: interrupted", or "PLACE: the
/// time limit has passed".
class Stopped : public std::runtime_error {
 public:
  /// `place`: what was being done or read; may be empty.
  Stopped(StopReason reason, const std::string& place);
  StopReason reason() const { return reason_; }

 protected:
  struct Message {
    std::string all;
  };
  Stopped(StopReason reason, const Message& message) : std::runtime_error(message.all), reason_(reason) {}

 private:
  StopReason reason_;
};

}  // namespace noli
