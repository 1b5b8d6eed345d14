// SPDX-License-Identifier: Apache-2.0
//
// A finding that cannot be saved (a full disk) is told all the same: what went wrong is kept, and thrown when all that
// was found has been written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include <noli/errors.h>

namespace noli::audit {

class NotSaved {
 public:
  /// Calls `save`, which may throw std::system_error. False if it did; the first of these is kept.
  template <class Save>
  bool attempt(const Save& save) {
    try {
      save();
      return true;
    } catch (const std::system_error& error) {
      if (!why_) why_ = error.what();
      return false;
    }
  }

  /// Throws WriteError if something was not saved.
  void require_nothing() const {
    if (why_) throw WriteError("not all that was found is saved: " + *why_);
  }

 private:
  std::optional<std::string> why_;
};

}  // namespace noli::audit
