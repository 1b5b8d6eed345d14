// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the whole program with scenes (audit/fuzz/scenes/scene_generators.h): each is simulated, the run verified
// and its proof checked, and simulated again with an interruption, after which it has to go on with the same bytes.
//
// Notation
//   finding  of a valid scene: an exit code that is not documented, or does not agree with the verdict; a run that is
//            not verified, or whose proof is not accepted; other bytes after an interruption; a refusal that does not
//            name the file; a crash, a hang. Of a scene that is wrong: anything but exit code 3 and a message that
//            names the place
//
// A run that ends early because of a contact, too many layers or numbers that run out is none: that is documented. So
// is a valid scene that is refused, with a message.
//
// What this does not do: it does not look whether the physics is right.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/fuzz/fuzzing.h"
#include "audit/fuzz/scenes/scene_generators.h"
#include "certify/process/run_program.h"

namespace noli::audit {

/// Runs `noli` with these arguments. Called from several threads at once.
using RunNoli = std::function<ProgramEnd(const std::vector<std::string>&)>;

/// This program as the subject. Each run ends after 120 seconds, or when `stop` is set. `stop` must outlive the result.
/// Throws std::system_error if noli_check is missing: each scene would be a finding.
RunNoli noli_as_subject(const std::atomic<bool>& stop);

struct SceneFuzzOptions : FuzzSettings {
  RunNoli noli;
  std::size_t max_alike = 3;        ///< findings with the same words that are kept
  std::size_t shrink_budget = 150;  ///< scenes to try for each of them
};

struct SceneFinding : FuzzFinding {
  SceneJson scene, shrunk;  ///< as made; simpler, and still a finding
  std::optional<std::string> wrong_place{};
};

struct SceneFuzzReport : FuzzTotals {
  /// By generator, how often simulations came to which end: "exit 0", ...
  std::map<std::string, std::map<std::string, std::uint64_t>> ends;
  std::uint64_t verified = 0, resumed = 0;
  std::vector<SceneFinding> findings;
};

/// Runs until a limit. What cannot be saved is in `not_saved`. Throws InputError for a corpus that cannot be read,
/// std::system_error when the folder cannot be used.
SceneFuzzReport fuzz_scenes(const SceneFuzzOptions& options);

/// What came of one scene.
struct SceneJudgement {
  std::string end;  ///< of the simulation: "exit 0 done", ...
  bool verified = false, resumed = false, stopped = false;
  std::optional<std::string> difference;
};

/// A scene that was saved. Throws InputError.
SceneJson read_saved_scene(const std::filesystem::path& file);

/// Simulates, verifies, checks and resumes the scene in a temporary folder.
SceneJudgement judge_scene(const GeneratedScene& scene, const RunNoli& noli);

struct ReplayedScene {
  SceneJson scene;  ///< smaller if that was asked for and something is wrong with it
  SceneJudgement judgement;
};

/// Judges a saved scene again. `smaller`: it is made smaller if something is wrong.
ReplayedScene replay_scene(GeneratedScene scene, bool smaller, const RunNoli& noli);

/// A scene for which `fails` holds and that is not simpler without one of its members, or with a shorter number. Stops
/// early after so many calls. Precondition: fails(scene).
SceneJson minimise(const SceneJson& scene, const std::function<bool(const SceneJson&)>& fails, std::size_t budget);

}  // namespace noli::audit
