// SPDX-License-Identifier: Apache-2.0
//
// Names the bodies whose cells a run does not compare: a statement that nothing touches must say what it leaves out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <noli/findings.h>
#include <noli/mesh.h>
#include "certify/body_names.h"
#include "certify/json.h"

namespace noli {

/// `held`: one per vertex, nonzero if it is scripted or pinned.
NotCompared not_compared(const Mesh& mesh, std::span<const std::uint8_t> held, const Exclusions& exclusions,
                         const BodyNames& names);

/// A pair on one line: "a and b"; or "a", if it is one body.
std::string pair_text(const std::array<std::string, 2>& pair);

/// "two cells of a and b whose vertices are all scripted or pinned"; names at most a few bodies, or none if their names
/// are unknown.
std::string held_text(const NotCompared& left_out);

/// "214 pairs of cells that intersect in the first frame".
std::string baseline_text(const NotCompared& left_out);

/// "Nothing touches" or "Nothing that is compared touches", then `where` and a full stop; then names at most a few of
/// the bodies that are not compared.
std::string nothing_touches(const NotCompared& left_out, const std::string& where);

/// "nothing touches", or "nothing that is compared touches; not compared: ...", for the line of the verdict.
std::string nothing_touches_in_short(const NotCompared& left_out);

}  // namespace noli
