// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/one_file_frames.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <noli/errors.h>
#include "trajectory/formats/frame_look.h"
#include "trajectory/stop.h"

namespace noli {

OneFileFrames::OneFileFrames(const std::filesystem::path& file) : facts_(1) {
  facts_[0].file = file.string();
  opened_ = state();
}

OneFileFrames::State OneFileFrames::state() const {
  struct stat status = {};
  if (::stat(facts_[0].file.c_str(), &status) != 0) return {};
  return {static_cast<std::uintmax_t>(status.st_size), status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::string OneFileFrames::name(std::size_t k) const { return fmt::format("{}[{}]", facts_[0].file, k); }

void OneFileFrames::look_at(std::size_t /*k*/) {
  FrameFacts& facts = facts_[0];
  if (facts.looked_at) return;
  const FrameFacts found = file_facts(facts.file, [] { return stop_asked().has_value(); });
  facts.bytes = found.bytes;
  facts.sha256 = found.sha256;
  facts.looked_at = true;
  require_unchanged();
}

void OneFileFrames::describe(const std::string& numbers, std::size_t vertices, std::size_t cells, std::size_t frames) {
  FrameFacts& facts = facts_[0];
  facts.numbers = numbers;
  facts.vertices = vertices;
  facts.cells = cells;
  facts.frames = frames;
}

void OneFileFrames::require_unchanged() const {
  if (state() == opened_) return;
  throw InputError(facts_[0].file, "",
                   "has changed since it was opened; verify the frames again once the file is complete");
}

}  // namespace noli
