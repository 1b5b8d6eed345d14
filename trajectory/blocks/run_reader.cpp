// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include <noli/errors.h>
#include "trajectory/blocks/run_checks.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_payload.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// Which kinds may come after `before` in a window; a window ends with its commit.
std::vector<FourLetters> successors(FourLetters before, RecordMode record) {
  switch (before) {
    case run_kind::window: return {record == RecordMode::full ? run_kind::lines : run_kind::lines_hash};
    case run_kind::lines_hash:
    case run_kind::frame: return {run_kind::frame, run_kind::ends};
    case run_kind::lines:
    case run_kind::ends: return {run_kind::velocities};
    case run_kind::velocities: return {run_kind::state};
    case run_kind::state: return {block_format::commit};
    default: return {run_kind::window};
  }
}

/// Whether every world line begins and ends at exactly these times.
bool spans(const WorldLines& lines, double begin, double end) {
  for (VertexId v = 0; v < lines.vertex_count(); ++v) {
    if (!same_bits(lines.times(v).front(), begin) || !same_bits(lines.times(v).back(), end)) return false;
  }
  return true;
}

/// The path of the motion. A folder without it was never a run, so the error names the folder and not the file.
std::filesystem::path require_trajectory(const std::filesystem::path& folder) {
  std::filesystem::path path = trajectory_path(folder);
  std::error_code error;
  if (std::filesystem::status(path, error).type() != std::filesystem::file_type::not_found) return path;
  throw InputError(folder.string(), "", "is not a run: it has no trajectory.blocks");
}

}  // namespace

RunReader::RunReader(const std::filesystem::path& folder) : blocks_(require_trajectory(folder), run_kind::content) {
  read_scene();
}

RunReader::RunReader(std::string bytes, std::string name)
    : blocks_(std::move(bytes), std::move(name), run_kind::content) {
  read_scene();
}

void RunReader::fail(const Block& block, const std::string& problem) const {
  throw InputError(blocks_.name(), byte_place(block.offset), problem);
}

Block RunReader::scene_block(FourLetters kind, std::optional<FourLetters> or_kind) {
  auto block = blocks_.next();
  if (!block) throw InputError(blocks_.name(), "", "ends before its first commit; expected header, mesh and labels");
  if (block->kind != kind && block->kind != or_kind) {
    fail(*block,
         fmt::format("expected block {}, found {}", letters_of(or_kind.value_or(kind)), letters_of(block->kind)));
  }
  return std::move(*block);
}

void RunReader::read_scene() {
  const Block head = scene_block(run_kind::head);
  scene_.header = run_block::decode_head({blocks_.name(), head});
  const Block mesh = scene_block(run_kind::mesh);
  scene_.mesh = run_block::decode_mesh({blocks_.name(), mesh});
  const Block labels = scene_block(run_kind::labels);
  scene_.labels = run_block::decode_labels({blocks_.name(), labels}, scene_.mesh.vertex_count);
  Block next = scene_block(run_kind::exclusions, block_format::commit);
  if (next.kind == block_format::commit) return;
  scene_.exclusions = run_block::decode_exclusions({blocks_.name(), next}, scene_.mesh);
  scene_block(block_format::commit);
}

/// The blocks of the next window, without its commit; nothing when there is no commit.
std::optional<std::vector<Block>> RunReader::window_blocks() {
  std::vector<Block> blocks;
  FourLetters before = block_format::commit;
  while (auto block = blocks_.next()) {
    const auto expected = successors(before, scene_.header.record);
    if (std::find(expected.begin(), expected.end(), block->kind) == expected.end()) {
      fail(*block, fmt::format("expected block {}, found {}", letters_of(expected.back()), letters_of(block->kind)));
    }
    if (block->kind == block_format::commit) return blocks;
    before = block->kind;
    blocks.push_back(std::move(*block));
  }
  return std::nullopt;
}

void RunReader::decode_full(const std::vector<Block>& blocks, RunWindow& window) const {
  const Block& block = blocks[1];
  window.lines = run_block::decode_lines({blocks_.name(), block}, scene_.header.dimension, scene_.mesh.vertex_count);
  if (!spans(*window.lines, window.begin, window.end)) {
    fail(block, fmt::format("world lines from {:.17g} to {:.17g} in a window from {:.17g} to {:.17g}",
                            window.lines->first_time(), window.lines->last_time(), window.begin, window.end));
  }
  window.breakpoints = count_breakpoints(*window.lines);
  window.positions = positions_at_end(*window.lines);
  if (!last_) return;
  const std::string problem = position_problem(*last_, *window.lines);
  if (!problem.empty()) fail(block, problem);
}

void RunReader::decode_frames(const std::vector<Block>& blocks, RunWindow& window) const {
  const std::uint32_t dimension = scene_.header.dimension;
  const std::size_t vertex_count = scene_.mesh.vertex_count;
  run_block::decode_lines_hash({blocks_.name(), blocks[1]}, window);
  const std::size_t ends = blocks.size() - 3;
  for (std::size_t i = 2; i < ends; ++i) {
    window.frames.push_back(run_block::decode_frame({blocks_.name(), blocks[i]}, dimension, vertex_count));
  }
  window.positions = run_block::decode_vectors({blocks_.name(), blocks[ends]}, dimension, vertex_count);
  const WindowEnd end{window.end, window.positions};
  const std::string problem = frames_problem(window.index, window.begin, end, window.frames);
  if (!problem.empty()) fail(blocks[2], problem);
}

std::optional<RunWindow> RunReader::next_window() {
  std::optional<std::vector<Block>> blocks = window_blocks();
  if (!blocks) {
    require_count(windows());
    return std::nullopt;
  }
  RunWindow window = run_block::decode_window({blocks_.name(), blocks->front()});
  if (window.index != windows() - 1) {
    fail(blocks->front(), fmt::format("window {} where window {} was expected", window.index + 1, windows()));
  }
  const std::string problem = last_ ? time_problem(*last_, window.begin) : "";
  if (!problem.empty()) fail(blocks->front(), problem);
  scene_.header.record == RecordMode::full ? decode_full(*blocks, window) : decode_frames(*blocks, window);
  window.velocities = run_block::decode_vectors({blocks_.name(), (*blocks)[blocks->size() - 2]},
                                                scene_.header.dimension, scene_.mesh.vertex_count);
  window.state = std::move(blocks->back().payload);
  window.group_hash = blocks_.committed().group;
  last_ = WindowEnd{window.end, window.positions};
  if (windows() == known_.count) require_hash(running_hash());
  return window;
}

void RunReader::skip_to(std::uint64_t window) {
  while (windows() < window) {
    if (!skip_window()) throw InputError(blocks_.name(), "", fmt::format("ends before window {}", window + 1));
  }
}

void RunReader::skip_to(const CommitPoint& commit) {
  blocks_.continue_after(commit);
  last_.reset();
}

bool RunReader::skip_window() {
  if (!blocks_.skip_group()) return false;
  last_.reset();
  if (windows() == known_.count) require_hash(running_hash());
  return true;
}

void RunReader::expect(const KnownWindows& known) {
  known_ = known;
  if (windows() == known_.count) require_hash(running_hash());
}

void RunReader::require_count(std::uint64_t count) const {
  if (count >= known_.count || known_.made_again) return;
  throw InputError(blocks_.name(), "",
                   fmt::format("windows are missing: it has {}, the log lists {}", count, known_.count));
}

void RunReader::require_hash(const Sha256Digest& running) const {
  if (!known_.running || running == *known_.running) return;
  throw InputError(
      blocks_.name(), fmt::format("window {}", known_.count),
      fmt::format("has running hash {}; expected {}, which the log has", hex(running), hex(*known_.running)));
}

void RunReader::look_for_expected() {
  const CommitLook look = blocks_.look_at_commits(known_.count + 1);
  require_count(std::max<std::uint64_t>(look.count, 1) - 1);
  if (look.running) require_hash(*look.running);
}

RunLook RunReader::look() {
  const CommitLook look = blocks_.look_at_commits();
  if (look.count < 2) return {};
  const std::optional<Block> block = blocks_.look_at_block(look.last_group);
  RunLook result{look.count - 1, std::nullopt};
  if (!block || block->kind != run_kind::window) return result;
  try {
    result.end = run_block::decode_window({blocks_.name(), *block}).end;
  } catch (const InputError&) {
  }
  return result;
}

std::string RunReader::open_window_message() const {
  return fmt::format("{}: ends in an open window at {}", blocks_.name(), byte_place(open_window().value()));
}

}  // namespace noli
