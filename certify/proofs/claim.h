// SPDX-License-Identifier: Apache-2.0
//
// What is claimed of a motion, as `noli verify` asks it and a checker says it (proofs/FORMAT.md, section 6): compared
// field by field, and as a file that `noli check --claim` reads.
//
// What this does not do: it does not decide which of two claims is the stronger one. Checkers do.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certify/json.h"
#include "proofs/prover/cells/labels.h"
#include "trajectory/mesh.h"

namespace noli {

struct Claim {
  std::string motion = "linear";  ///< or "rest", "run"
  int dimension = 3;
  std::uint64_t steps = 0;
  bool strict = false, points = false;
  double distance = 0;
  std::uint32_t ring = 1;
  std::uint64_t merged = 0;  ///< vertices
  LabelPairs excluded;
  std::string cells;        ///< their hash
  bool empty = false;       ///< fewer than two cells can be compared
  double from = 0, to = 0;  ///< T0 of the first step, T1 of the last

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// Sets what the cells (after merging) and their labels say: their hash, what is excluded, and whether the claim is
/// empty; `strict` is set before.
void set_cells(Claim& claim, const Mesh& mesh, std::span<const std::uint32_t> labels, const LabelPairs& excluded);

/// As a checker's words have it behind the verdict's line; nothing if they have none, or another form.
std::optional<Claim> claim_of_words(const std::string& words);

/// The words of --require that ask for just this claim.
std::vector<std::string> fields_of(const Claim& claim);

/// Those of them that `noli check` does not ask by itself.
std::vector<std::string> fields_beyond_default(const Claim& claim);

/// The first field in which a checker's claim is another than the one that was asked, in words; nothing if none is. Of
/// a claim that is refuted, steps behind the witness count for nothing.
std::optional<std::string> difference(const Claim& asked, const Claim& checked, bool refuted);

/// What makes it weaker than what a checker asks by default: "frames at rest", "12 merged vertices", ...
std::vector<std::string> weakenings(const Claim& claim);

Json claim_json(const Claim& claim);

/// The file CLAIM.json: schema "noli-claim", version 1.
Json claim_file(const Claim& claim);
/// The words of --require that such a file asks for; members that are not there are not asked by name. Throws
/// InputError.
std::vector<std::string> read_claim_file(const std::filesystem::path& file);

}  // namespace noli
