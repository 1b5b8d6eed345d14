// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace noli::certificates {

/// What certificates cost.
struct CertificateCounts {
  std::uint64_t slices = 0;
  std::uint64_t tubes = 0;                           ///< left before the slice's end
  std::uint64_t plans = 0;                           ///< guards made
  std::uint64_t penned = 0;                          ///< of these, those inside a pen
  std::uint64_t repairs = 0;                         ///< slabs
  std::uint64_t activations = 0, deactivations = 0;  ///< of layers
  std::uint64_t most_near = 0;                       ///< near pairs at a time
  std::uint32_t deepest = 0;                         ///< layer

  CertificateCounts& operator+=(const CertificateCounts& other) {
    slices += other.slices;
    tubes += other.tubes;
    plans += other.plans;
    penned += other.penned;
    repairs += other.repairs;
    activations += other.activations;
    deactivations += other.deactivations;
    most_near = std::max(most_near, other.most_near);
    deepest = std::max(deepest, other.deepest);
    return *this;
  }
};

}  // namespace noli::certificates
