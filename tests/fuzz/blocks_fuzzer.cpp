// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the reader of runs: any bytes give windows or an InputError of one line. A run with all its world lines is
// written again from what was read and must have the same bytes, up to the last commit.
//
// Input: 'R' and the bytes of a file, or 'B' and blocks. The blocks become a file with correct checksums and commits,
// which no mutation would find. A block is a byte for its kind, two for its length, and the payload.
#include <array>
#include <string>
#include <string_view>

#include "check_frame.h"
#include "tests/trajectory/run_samples.h"
#include "trajectory/blocks/run_payload.h"

namespace {

using noli::fuzz::require;
namespace kind = noli::run_kind;

constexpr std::array kinds = {
    noli::block_format::commit, kind::head,  kind::mesh, kind::labels,     kind::exclusions, kind::window, kind::lines,
    kind::lines_hash,           kind::frame, kind::ends, kind::velocities, kind::state};

/// The file made of these blocks.
std::string file_of_blocks(std::string_view rest) {
  noli::testing::MemoryFile file;
  noli::BlockWriter writer(noli::testing::sink_to(file), kind::content);
  while (rest.size() >= 3) {
    const auto at = [rest](std::size_t i) { return static_cast<unsigned char>(rest[i]); };
    const noli::FourLetters letters = kinds[at(0) % kinds.size()];
    const std::string_view payload = rest.substr(3, at(1) + 256u * at(2));
    letters == noli::block_format::commit ? writer.commit() : writer.append(letters, payload);
    rest.remove_prefix(3 + payload.size());
  }
  return file.bytes;
}

void check_window(const noli::RunWindow& window, const noli::RunReader& reader) {
  const std::size_t count = reader.mesh().vertex_count;
  require(window.index + 1 == reader.windows() && window.begin < window.end);
  require(window.positions.size() == count && window.velocities.size() == count);
  require(window.lines.has_value() == (reader.header().record == noli::RecordMode::full));
  if (window.lines) require(window.lines->vertex_count() == count && window.frames.empty());
}

void read_and_write(const std::string& bytes) {
  noli::RunReader reader(bytes, "input");
  noli::fuzz::check_indices(reader.mesh());
  noli::testing::MemoryFile file;
  noli::RunWriter writer(noli::testing::sink_to(file), reader.scene());
  while (const auto window = reader.next_window()) {
    check_window(*window, reader);
    if (!window->lines) continue;
    writer.append_window({window->index, *window->lines, window->velocities, window->state, {}});
    writer.commit();
  }
  require(reader.open_window().value_or(bytes.size()) <= bytes.size());
  if (reader.header().record == noli::RecordMode::full) {
    require(file.bytes == bytes.substr(0, reader.open_window().value_or(bytes.size())));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    read_and_write(data[0] == 'R' ? std::string(rest) : file_of_blocks(rest));
  } catch (const noli::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input: ") && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
