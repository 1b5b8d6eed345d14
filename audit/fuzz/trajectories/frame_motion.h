// SPDX-License-Identifier: Apache-2.0
//
// The motions that `noli fuzz trajectories` makes: a mesh and a few frames of it, as files would have them.
//
// Notation
//   step k    from frame k to frame k + 1, at constant velocity. A single frame is one step at rest (verify --static)
//   P, Q      features: vertices of two cells, ascending, none of them in both
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>

namespace noli::audit {

/// What the frames are written as.
enum class FrameFormat : std::uint8_t { ply_ascii, ply_binary, obj };

struct FrameMotion {
  Mesh mesh;  ///< without redundant cells (trajectory/cells.h), with at least one cell
  std::vector<std::vector<Position>> frames;
  FrameFormat format = FrameFormat::ply_ascii;

  bool at_rest() const { return frames.size() == 1; }
  std::size_t steps() const { return at_rest() ? 1 : frames.size() - 1; }
  /// Positions at the beginning and at the end of a step.
  const std::vector<Position>& begin(std::size_t step) const { return frames[step]; }
  const std::vector<Position>& end(std::size_t step) const { return frames[at_rest() ? step : step + 1]; }
  /// As `noli verify` has it: 2 if all z of the first two frames are equal, else 3.
  int dimension() const;
};

/// The bytes of a frame as a file.
std::string file_bytes(const FrameMotion& motion, std::size_t frame);

/// Writes the frames, frame-0.ply, frame-1.ply, ..., into a folder that is there; the files in their order.
std::vector<std::filesystem::path> write_frames(const FrameMotion& motion, const std::filesystem::path& folder);

/// Reads what write_frames wrote. Throws InputError.
FrameMotion read_frames(const std::filesystem::path& folder);

/// A finding as a folder: its frames, and a README with what is wrong and with the words of the command that shows it
/// again, to which the folder is added. All of it or nothing (audit/fuzz/save_finding.h). Throws std::system_error.
void save_motion(const FrameMotion& motion, const std::string& difference, std::vector<std::string> replay_command,
                 const std::filesystem::path& folder);

/// The number of "frame-12.ply" or "frame-12.obj" with the prefix "frame-"; nothing for other names.
std::optional<std::size_t> frame_number(const std::filesystem::path& file, std::string_view prefix);

/// What is wrong with the bytes of the frames, in words: reading them again has to give the mesh and the same bits.
/// Nothing if all is well.
std::string text_fault(const FrameMotion& motion);

}  // namespace noli::audit
