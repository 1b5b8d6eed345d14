// SPDX-License-Identifier: Apache-2.0
//
// Generators of small scenes for `noli fuzz scenes`: a few bodies of a few cells that fly at each other, with one thing
// about them extreme; and scenes that are wrong in one known place.
//
// Each runs within a fraction of a second: windows are short where steps are. Numbers are products of powers of two and
// short decimals, the same on every machine.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "audit/fuzz/random.h"

namespace noli::audit {

using SceneJson = nlohmann::ordered_json;

struct GeneratedScene {
  SceneJson scene;
  /// Of a scene that is wrong: what the message has to name.
  std::optional<std::string> wrong_place;
};

struct SceneGenerator {
  std::string_view name;
  std::string_view attacks;  ///< one line
  GeneratedScene (*make)(Random& random);
};

/// All generators; the order never depends on anything.
std::span<const SceneGenerator> scene_generators();

}  // namespace noli::audit
