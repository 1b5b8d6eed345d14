// SPDX-License-Identifier: Apache-2.0
//
// Which pairs of a run's cells are not compared, by the names of their bodies: what says that nothing touches has to
// say of what it does not speak.
//
// What this does not do: it does not say which cells, nor whether they touch.
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

/// `held`: one per vertex, not 0 if it is scripted or pinned.
NotCompared not_compared(const Mesh& mesh, std::span<const std::uint8_t> held, const Exclusions& exclusions,
                         const BodyNames& names);

/// Both of a pair on one line: "a and b"; or "a", if it is one body.
std::string pair_text(const std::array<std::string, 2>& pair);

/// "two cells of a and b whose vertices are all scripted or pinned"; without names, if none are known, and not more
/// than a few.
std::string held_text(const NotCompared& left_out);

/// "Nothing touches" or "Nothing that is compared touches", then `where` and a full stop; and what is not compared, by
/// name, but not more than a few.
std::string nothing_touches(const NotCompared& left_out, const std::string& where);

/// "nothing touches", or "nothing that is compared touches; not compared: ...", for the line of the verdict.
std::string nothing_touches_in_short(const NotCompared& left_out);

}  // namespace noli
