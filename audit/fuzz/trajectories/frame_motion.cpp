// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/frame_motion.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <exception>
#include <system_error>

#include <noli/errors.h>
#include "audit/fuzz/save_finding.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/write_obj.h"
#include "trajectory/formats/write_ply.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

std::string file_name(std::size_t frame, FrameFormat format) {
  return fmt::format("frame-{}.{}", frame, format == FrameFormat::obj ? "obj" : "ply");
}

bool same_bits(const std::vector<Position>& a, const std::vector<Position>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t v = 0; v < a.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::bit_cast<std::uint64_t>(a[v][axis]) != std::bit_cast<std::uint64_t>(b[v][axis])) return false;
    }
  }
  return true;
}

FrameFormat format_of(const fs::path& file) {
  if (file.extension() == ".obj") return FrameFormat::obj;
  const bool ascii = read_whole_file(file).find("format ascii") != std::string::npos;
  return ascii ? FrameFormat::ply_ascii : FrameFormat::ply_binary;
}

constexpr std::string_view frame_prefix = "frame-";

/// Frames behind a gap in the numbers, or in the other format.
void require_no_more(const fs::path& folder, const fs::path& missing) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto number = frame_number(entry.path(), frame_prefix);
    const std::string name = entry.path().filename().string();
    if (!number) continue;
    if (*number >= frame_number(missing, frame_prefix))
      throw InputError(folder.string(), "", fmt::format("has {}, but no {}", name, missing.filename().string()));
    if (entry.path().extension() == missing.extension()) continue;
    const std::string read = fs::path(name).replace_extension(missing.extension()).string();
    throw InputError(folder.string(), "", fmt::format("has both {} and {}; expected one of them", name, read));
  }
}

}  // namespace

int FrameMotion::dimension() const {
  const bool plane = all_z_equal(begin(0)) && all_z_equal(end(0)) && begin(0)[0][2] == end(0)[0][2];
  return plane ? 2 : 3;
}

std::string file_bytes(const FrameMotion& motion, std::size_t frame) {
  const Frame one{motion.mesh, motion.frames[frame]};
  if (motion.format == FrameFormat::obj) return format_obj(one);
  const bool ascii = motion.format == FrameFormat::ply_ascii;
  return format_ply(one, ascii ? PlyEncoding::ascii : PlyEncoding::binary_little_endian);
}

std::vector<fs::path> write_frames(const FrameMotion& motion, const fs::path& folder) {
  std::vector<fs::path> files;
  for (std::size_t frame = 0; frame < motion.frames.size(); ++frame) {
    files.push_back(folder / file_name(frame, motion.format));
    write_file(files.back(), file_bytes(motion, frame));
  }
  return files;
}

void save_motion(const FrameMotion& motion, const std::string& difference, std::vector<std::string> replay_command,
                 const fs::path& folder) {
  replay_command.push_back(folder.string());
  save_whole(folder, difference, replay_command, [&](const fs::path& to) { write_frames(motion, to); });
}

std::optional<std::size_t> frame_number(const fs::path& file, std::string_view prefix) {
  const std::string name = file.filename().string();
  if (!name.starts_with(prefix) || (file.extension() != ".ply" && file.extension() != ".obj")) return std::nullopt;
  std::size_t number = 0;
  const char* const end = name.data() + name.size() - 4;
  const auto [last, error] = std::from_chars(name.data() + prefix.size(), end, number);
  return error == std::errc() && last == end ? std::optional(number) : std::nullopt;
}

FrameMotion read_frames(const fs::path& folder) {
  FrameMotion motion;
  motion.format = FrameFormat::obj;
  if (!fs::exists(folder / file_name(0, motion.format))) motion.format = FrameFormat::ply_ascii;
  const fs::path first = folder / file_name(0, motion.format);
  if (!fs::exists(first)) throw InputError(folder.string(), "", "expected a folder with frame-0.ply or frame-0.obj");
  motion.format = format_of(first);
  for (std::size_t frame = 0;; ++frame) {
    const fs::path file = folder / file_name(frame, motion.format);
    if (!fs::exists(file)) {
      require_no_more(folder, file);
      return motion;
    }
    Frame one = read_frame(file);
    if (frame == 0) motion.mesh = one.mesh;
    require_same_mesh(motion.mesh, first, one.mesh, file);
    if (motion.mesh.cell_count() == 0)
      throw InputError(file.string(), "", "no cells; expected something that can touch");
    motion.frames.push_back(std::move(one.positions));
  }
}

std::string text_fault(const FrameMotion& motion) {
  for (std::size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const std::string file = file_name(frame, motion.format);
    try {
      const Frame again = parse_frame(file_bytes(motion, frame), file);
      if (again.mesh != motion.mesh) return fmt::format("{}: the mesh is different when it is read again", file);
      if (!same_bits(again.positions, motion.frames[frame])) {
        return fmt::format("{}: positions have different bits when they are read again", file);
      }
    } catch (const std::exception& error) {
      return fmt::format("{}: cannot be read again: {}", file, error.what());
    }
  }
  return "";
}

}  // namespace noli::audit
