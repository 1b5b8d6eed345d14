// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/stored_frames.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <noli/errors.h>
#include "trajectory/formats/frame_look.h"
#include "trajectory/stop.h"

namespace noli {

StoredFrames::StoredFrames(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) {
    facts_.emplace_back().file = file.string();
    opened_.push_back(state_of(facts_.back().file));
  }
}

StoredFrames::State StoredFrames::state_of(const std::string& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0) return {};
  return {static_cast<std::uintmax_t>(status.st_size), status.st_dev, status.st_ino, status.st_ctim.tv_sec,
          status.st_ctim.tv_nsec};
}

std::string StoredFrames::name(std::size_t k) const { return frame_name(facts_, k); }

void StoredFrames::look_at(std::size_t k) {
  for (std::size_t i = 0, first = 0; i < facts_.size(); first += facts_[i].frames, ++i) {
    FrameFacts& facts = facts_[i];
    const bool wanted = facts.frames == 0 ? k == 0 : k >= first && k < first + facts.frames;
    if (!wanted || facts.looked_at) continue;
    const FrameFacts found = file_facts(facts.file, [] { return stop_asked().has_value(); });
    facts.bytes = found.bytes;
    facts.sha256 = found.sha256;
    facts.looked_at = true;
    require_unchanged(i);
  }
}

void StoredFrames::require_unchanged(std::size_t file) const {
  if (state_of(facts_[file].file) == opened_[file]) return;
  throw InputError(facts_[file].file, "",
                   "has changed since it was opened; verify the frames again once the file is complete");
}

void StoredFrames::require_same_bytes() const {
  for (const FrameFacts& facts : facts_) {
    if (!facts.looked_at) continue;
    if (file_facts(facts.file, [] { return stop_asked().has_value(); }).sha256 == facts.sha256) continue;
    throw InputError(facts.file, "",
                     "has changed since it was looked at; verify the frames again once the file is complete");
  }
}

std::uint64_t frame_count(const std::vector<FrameFacts>& files) {
  std::uint64_t count = 0;
  for (const FrameFacts& facts : files) count += facts.body == files[0].body ? facts.frames : 0;
  return count;
}

std::string frame_name(const std::vector<FrameFacts>& files, std::size_t k) {
  for (const FrameFacts& facts : files) {
    if (k < facts.frames) return facts.frames == 1 ? facts.file : fmt::format("{}[{}]", facts.file, k);
    k -= facts.frames;
  }
  return fmt::format("frame {}", k);
}

}  // namespace noli
