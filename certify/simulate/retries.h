// SPDX-License-Identifier: Apache-2.0
//
// How often a window in which something touches is run again, and with what changed (design, "Certified windows").
//
// What this does not do: it runs nothing.
#pragma once

#include <cstdint>
#include <optional>

namespace noli {

/// What is changed for one more try.
struct Retry {
  std::uint32_t least_layers = 0;  ///< of all pairs that are followed
  std::uint64_t halvings = 0;      ///< of the steps of all layers, since the run began
};

class Retries {
 public:
  static constexpr int most = 8;

  /// For a run in which steps have been halved so often.
  explicit Retries(std::uint64_t halvings = 0) : halvings_(halvings) {}

  /// The next try of the same window; nothing when all have been. First with more layers than the deepest that was
  /// reached, in case that certificates missed one; then with steps halved once more each time.
  std::optional<Retry> next(std::uint32_t deepest) {
    if (tries_ == most) return std::nullopt;
    if (++tries_ == 1) return Retry{deepest + 8, halvings_};
    return Retry{0, ++halvings_};
  }

  /// The window has been committed. True if more layers were enough: then certificates had missed one.
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
