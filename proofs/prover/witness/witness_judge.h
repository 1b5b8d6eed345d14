// SPDX-License-Identifier: Apache-2.0
//
// Judges a witness before it is written: all conditions and limits of proofs/FORMAT.md, section 5.
//
// It starts from the bytes, and shares no arithmetic with the search (proofs/prover/witness/witness.h): rational
// numbers instead of integers, polynomials of its own.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "proofs/prover/witness/witness.h"

namespace noli {

/// Why a checker would refuse the payload of a block WITN, in words; nothing if it holds.
std::optional<std::string> fault_of_witness(const WitnessStep& step, std::string_view payload);

}  // namespace noli
