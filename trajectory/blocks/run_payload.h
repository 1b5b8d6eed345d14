// SPDX-License-Identifier: Apache-2.0
//
// Converts the payloads of a run's blocks to and from bytes. Internal to run_file.h; FORMAT.md has the bytes.
//
// encode_X trusts its arguments. decode_X checks everything that the block alone can show, and throws InputError with
// the place in the file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/run_file.h"

/// The content of a run's block file, and the kinds of its blocks.
namespace noli::run_kind {
inline constexpr FourLetters content = four_letters("TRAJ");
inline constexpr FourLetters head = four_letters("HEAD");
inline constexpr FourLetters mesh = four_letters("MESH");
inline constexpr FourLetters labels = four_letters("LABL");
inline constexpr FourLetters exclusions = four_letters("EXCL");
inline constexpr FourLetters window = four_letters("WIND");
inline constexpr FourLetters lines = four_letters("LINE");
inline constexpr FourLetters lines_hash = four_letters("HASH");
inline constexpr FourLetters frame = four_letters("FRAM");
inline constexpr FourLetters ends = four_letters("ENDP");
inline constexpr FourLetters velocities = four_letters("VELO");
inline constexpr FourLetters state = four_letters("STAT");
}  // namespace noli::run_kind

namespace noli::run_block {

std::string encode_head(const RunHeader& header);
std::string encode_mesh(const Mesh& mesh);
std::string encode_labels(std::span<const std::uint8_t> labels);
std::string encode_exclusions(const Exclusions& exclusions);
std::string encode_window(std::uint64_t index, double begin, double end);
/// Passes world lines on in parts, as they may be too many to be in memory twice.
std::uint64_t encoded_lines_size(std::uint32_t dimension, const WorldLines& lines);
void encode_lines(std::uint32_t dimension, const WorldLines& lines, const ByteConsumer& consumer);
std::string encode_vectors(std::uint32_t dimension, std::span<const Position> vectors);
std::string encode_frame(std::uint32_t dimension, const RunFrame& frame);
std::string encode_lines_hash(std::uint64_t breakpoints, const Sha256Digest& hash);

/// A block and the name of its file, for errors.
struct Source {
  const std::string& file;
  const Block& block;
};

RunHeader decode_head(const Source& source);
Mesh decode_mesh(const Source& source);
std::vector<std::uint8_t> decode_labels(const Source& source, std::size_t vertex_count);
/// `mesh`: the mesh to which they apply.
Exclusions decode_exclusions(const Source& source, const Mesh& mesh);
/// A window with only its index and times.
RunWindow decode_window(const Source& source);
WorldLines decode_lines(const Source& source, std::uint32_t dimension, std::size_t vertex_count);
std::vector<Position> decode_vectors(const Source& source, std::uint32_t dimension, std::size_t vertex_count);
RunFrame decode_frame(const Source& source, std::uint32_t dimension, std::size_t vertex_count);
/// Sets the number of breakpoints and their hash.
void decode_lines_hash(const Source& source, RunWindow& window);

}  // namespace noli::run_block
