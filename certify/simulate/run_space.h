// SPDX-License-Identifier: Apache-2.0
//
// How many bytes a run is about to write, and whether its disk will hold them.
//
// Predictions: world lines or frames as `noli explain` predicts them (integrator/scene/explain.h), and what a window
// takes beside them; of a proof so many bytes for each cell and window. A run that is gone on with is predicted from
// what its own windows took. Contact has no prediction: its layers add breakpoints for as long as things are near, so a
// scene with contact needs at least what is predicted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "integrator/scene/explain.h"
#include "integrator/scene/scene.h"

namespace noli {

/// What is to be written, and what of it is there.
struct RunToCome {
  std::filesystem::path run;
  std::size_t vertices = 0, cells = 0;
  std::uint64_t windows = 0;        ///< of the whole run, if none ends early
  double time = 0;                  ///< up to which it goes [s]
  std::uint64_t windows_there = 0;  ///< of the run that is gone on with
  double time_there = 0;            ///< up to which it has come [s]
  std::uint64_t bytes_there = 0;    ///< of trajectory.blocks and proof.blocks
  bool prove = true;                ///< with record full, proofs are written
  bool series = true;               ///< series.h5 is written
};

struct RunBytes {
  double motion = 0;      ///< trajectory.blocks, and proof.blocks if there is one
  double series = 0;      ///< series.h5
  bool full = true;       ///< world lines are recorded, not frames alone
  bool proved = false;    ///< with proofs
  bool at_least = false;  ///< contact may add to it

  double all() const { return motion + series; }
};

RunBytes bytes_to_come(const integrator::Scene& scene, const integrator::Explanation& explanation,
                       const RunToCome& run);

/// What may still be written to the file system that has this folder, or will have it; nothing when that is not known.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& folder);

/// Of all files in a folder.
std::uint64_t bytes_in(const std::filesystem::path& folder);

/// For whoever starts the run, without a full stop: "about 2.4 GB of world lines, proof and frames in runs/a; 80 GB are
/// free".
std::string space_note(const RunBytes& bytes, const std::filesystem::path& run, std::optional<std::uint64_t> free);

/// What is wrong when so many bytes are free; nothing when the run fits, or that is not known.
std::optional<std::string> space_problem(const RunBytes& bytes, const std::filesystem::path& run,
                                         std::optional<std::uint64_t> free);

/// "850 MB", "2.4 GB".
std::string bytes_text(double bytes);

}  // namespace noli
