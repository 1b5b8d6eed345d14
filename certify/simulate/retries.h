// SPDX-License-Identifier: Apache-2.0
//
// Decides how often a window with a contact is run again, and with which changes (design, "Certified windows").
#pragma once

#include <cstdint>
#include <optional>

namespace noli {

/// The changes for one more try.
struct Retry {
  std::uint32_t least_layers = 0;  ///< of all near pairs
  std::uint64_t halvings = 0;      ///< of the steps of all layers, since the run began
};

class Retries {
 public:
  static constexpr int most = 8;

  /// `halvings`: of the steps in the run so far.
  explicit Retries(std::uint64_t halvings = 0) : halvings_(halvings) {}

  /// The next try of the same window; nothing after the last one. The first try has more layers than the deepest that
  /// was reached, in case certificates missed one; each later try halves the steps once more.
  std::optional<Retry> next(std::uint32_t deepest) {
    if (tries_ == most) return std::nullopt;
    if (++tries_ == 1) return Retry{deepest + 8, halvings_};
    return Retry{0, ++halvings_};
  }

  /// Call this when the window has been committed. True if more layers were enough: certificates had missed one.
  bool committed() {
    const bool defect = tries_ == 1;
    tries_ = 0;
    return defect;
  }

  int tries() const { return tries_; }
  std::uint64_t halvings() const { return halvings_; }

 private:
  int tries_ = 0;
  std::uint64_t halvings_;
};

}  // namespace noli
