// SPDX-License-Identifier: Apache-2.0
//
// What keeps a question from being answered, beside InputError (trajectory/error.h) and Stopped (trajectory/stop.h).
#pragma once

#include <stdexcept>
#include <string>

namespace noli {

/// What is asked for cannot be. what() is one line.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Results could not be written. what() is one line.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A process that helps could not do its work, because of memory or files. what() is one line.
struct HelperError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace noli
