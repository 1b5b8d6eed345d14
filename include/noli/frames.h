// SPDX-License-Identifier: Apache-2.0
//
// Frames in files or given by a function: their order, how they are read, and facts about what was read.
//
//   const noli::OrderedFrames ordered = noli::order_frames({"cloth_1.ply", "cloth_2.ply", "cloth_10.ply"});
//
// Notation
//   number    a run of digits of any length, in the name without its extension or in its folders. Right after '_', '='
//             or at the beginning of a name a '-' is its sign; elsewhere '-' only separates. `e-05` and `e+05` after
//             digits are an exponent; `e05` is not
//   family    the names that differ in their numbers only: `cloth_1.ply` and `cloth_10.obj`, not `body_1.ply`
//   12.5      may be a decimal or two numbers. Read as decimals 0.10 comes before 0.9, read as two numbers after it.
//             When the two readings disagree, the user is asked. A family has decimals for certain when one fraction
//             begins with 0 and another has a different length (0.05, 0.1), or when one has an exponent. 1.2.3 is
//             three numbers
//   order     names of a family compare by their first number, then by the second, and so on. Numbers of folders come
//             before those of the file's own name
//
// Formats: PLY (ASCII and binary), OBJ, VTU and VTP. Arrays of numpy, files of frames and, where Noli is built with
// HDF5, VTKHDF and a run's series.h5 have the positions of many frames. Coordinates keep the unit of the file.
// Errors: as each function says. Thread safety: any thread; there is no state. Nothing here opens a file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli {

class FrameConverter;

enum class FrameOrder {
  checked,  ///< as given, which has to be the order of the numbers
  natural,  ///< sorted by the numbers
  given     ///< as given, whatever the numbers say
};

/// Frames in the order of time.
struct OrderedFrames {
  std::vector<std::filesystem::path> frames;
  std::string how;                 ///< one line: how they were ordered
  std::vector<std::string> notes;  ///< one line each: against the numbers, sorted, numbers missing, files given twice
};

/// Orders the frames. FrameOrder::natural sorts each family within the places it occupies; equal numbers stay as given,
/// and decimals are read as decimals. Throws an InputError that shows two names given against their numbers.
OrderedFrames order_frames(std::vector<std::filesystem::path> frames, FrameOrder order = FrameOrder::checked);

enum class PolygonRule {
  fan,    ///< cut into a fan
  refuse  ///< a polygon is an error
};

/// A body with frames of its own.
struct BodyFrames {
  std::string name;
  std::vector<std::filesystem::path> frames;  ///< in the order of time; one of a body that stands still
  bool still = false;
};

/// Where a body is in the mesh of all.
struct FrameBody {
  std::string name;
  std::uint64_t first_vertex = 0, vertices = 0, first_face = 0, faces = 0;
  bool still = false;
};

/// Frames in memory: arrays, or a solver's output. `frames` of the request then has one name, NAME; messages call frame
/// k NAME[k].
struct GivenFrames {
  Mesh mesh;                         ///< every index is below its vertex_count
  std::optional<std::size_t> count;  ///< nothing: `frame` says where the end is
  /// The positions of frame k = 0, 1, ..., one per vertex, which are copied; nothing after the last frame. Called from
  /// the threads of whoever reads, never twice at once. What it throws is passed on.
  std::function<std::optional<std::vector<Position>>(std::size_t k)> frame;
  bool again = false;               ///< `frame` may be called again from an earlier k on, with the same positions
  std::string numbers = "float64";  ///< as in FrameFacts: what the coordinates were before they were doubles
  std::vector<FrameBody> bodies = {};
};

/// How frames are read.
struct FrameReading {
  PolygonRule polygons = PolygonRule::fan;
  std::vector<std::string> keys;  ///< names of the arrays with positions and cells; empty: the only arrays that fit
  std::vector<BodyFrames> bodies = {};            ///< joined into one mesh; empty for frames of one mesh
  std::shared_ptr<const GivenFrames> given = {};  ///< these instead of files
  bool ahead = false;  ///< another thread reads the next file meanwhile: the positions of three frames are in memory

  /// For Noli itself: what reads HDF5.
  std::shared_ptr<const FrameConverter> hdf5 = {};
};

/// What was read of a frame.
struct FrameFacts {
  std::string file;                       ///< its name, as given; a path would take several times the memory
  bool looked_at = false;                 ///< else only the name is known
  std::uint64_t bytes = 0;                ///< of the file
  std::array<std::uint8_t, 32> sha256{};  ///< of its bytes; of given frames, of all x, y, z as little-endian doubles
  std::string numbers;  ///< of coordinates: "float64", "float32/float64", "text with 9 digits, 6 decimals"
  std::uint64_t vertices = 0;
  std::optional<std::uint64_t> cells;  ///< once a frame of the mesh has been parsed
  std::optional<int> rounded_at;       ///< k: text that may have been rounded to multiples of 10^k
  std::uint64_t decimals = 0;          ///< of such text
  std::uint64_t frames = 1;            ///< how many the file has
  std::vector<std::string> arrays;     ///< those of a .npz file that are read, the positions first
  std::string body;                    ///< the body that it has frames of; empty: there is one mesh
};

}  // namespace noli
