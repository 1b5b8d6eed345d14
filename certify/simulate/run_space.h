// SPDX-License-Identifier: Apache-2.0
//
// Predicts how many bytes a run is about to write, and whether they fit its disk.
//
// Predictions: world lines or frames as `noli explain` predicts them (integrator/scene/explain.h), and what else a
// window takes; for a proof a number of bytes for each cell and window. The prediction for a resumed run comes from its
// own windows. Contact is not predicted: its layers add breakpoints as long as bodies are near, so a scene with contact
// needs at least the predicted bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "integrator/scene/explain.h"
#include "integrator/scene/scene.h"

namespace noli {

/// What will be written, and which part of it exists.
struct RunToCome {
  std::filesystem::path run;
  std::size_t vertices = 0, cells = 0;
  std::uint64_t windows = 0;        ///< of the whole run, if none ends early
  double time = 0;                  ///< up to which it goes [s]
  std::uint64_t windows_there = 0;  ///< of the run that is resumed
  double time_there = 0;            ///< the time that it has reached [s]
  std::uint64_t bytes_there = 0;    ///< of trajectory.blocks and proof.blocks
  bool prove = true;                ///< with record full, proofs are written
  bool series = true;               ///< series.h5 is written
};

struct RunBytes {
  double motion = 0;      ///< trajectory.blocks, and proof.blocks if there is one
  double series = 0;      ///< series.h5
  bool full = true;       ///< world lines are recorded, not only frames
  bool proved = false;    ///< with proofs
  bool at_least = false;  ///< contact may add to it

  double all() const { return motion + series; }
};

RunBytes bytes_to_come(const integrator::Scene& scene, const integrator::Explanation& explanation,
                       const RunToCome& run);

/// The free bytes of the file system that has this folder, or will have it; nothing if unknown.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& folder);

/// The size of all files in a folder.
std::uint64_t bytes_in(const std::filesystem::path& folder);

/// A note for the user, without a full stop: "about 2.4 GB of world lines, proof and frames in runs/a; 80 GB are free".
std::string space_note(const RunBytes& bytes, const std::filesystem::path& run, std::optional<std::uint64_t> free);

/// What is wrong with this many free bytes; nothing if the run fits, or that is unknown.
std::optional<std::string> space_problem(const RunBytes& bytes, const std::filesystem::path& run,
                                         std::optional<std::uint64_t> free);

/// "850 MB", "2.4 GB".
std::string bytes_text(double bytes);

}  // namespace noli
