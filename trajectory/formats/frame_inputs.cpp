// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "trajectory/formats/frames.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// The same error, with the number of the frame.
template <class Error>
Error of_frame(const Error& error, const std::string& path, std::size_t k, std::size_t count) {
  if (count == 1) return error;
  return {path, "", fmt::format("{} (frame {} of {})", message_without_name(error.what(), path), k + 1, count)};
}

/// 5e-07 for k = -6: half of 10^k.
std::string half_of(int k) { return fmt::format("5e{:+03}", k - 1); }

}  // namespace

FrameInputs::FrameInputs(const std::vector<fs::path>& frames, PolygonRule rule, bool ahead)
    : rule_(rule), reads_ahead_(ahead), facts_(frames.size()), read_(frames.size(), false) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    try {
      mesh_format(frames[k]);
    } catch (const InputError& error) {
      throw of_frame(error, frames[k].string(), k, frames.size());
    }
    facts_[k].file = frames[k].string();
  }
}

void FrameInputs::look_at(std::size_t k) {
  const fs::path path = facts_[k].file;
  try {
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return;
    const std::string bytes = read_whole_file(path);
    look_at(k, bytes);
  } catch (const OtherMesh& error) {
    throw of_frame(error, facts_[k].file, k, facts_.size());
  } catch (const InputError& error) {
    throw of_frame(error, facts_[k].file, k, facts_.size());
  }
}

void FrameInputs::look_at(std::size_t k, std::string_view bytes) {
  FrameLook look = look_at_frame(bytes, facts_[k].file);
  if (first_) {
    require_same_cells(k, bytes, look);
  } else {
    if (!look.cells) {
      Polygons polygons{rule_};
      mesh_ = parse_frame(bytes, facts_[k].file, &polygons).mesh;
    }
    first_ = k;
    same_ = {look.cells};
  }
  facts_[k] = std::move(look.facts);
}

void FrameInputs::require_same_cells(std::size_t k, std::string_view bytes, const FrameLook& look) {
  if (look.cells && same_.contains(look.cells)) return;
  Polygons polygons{rule_};
  const std::string &first = facts_[*first_].file, &file = facts_[k].file;
  if (!mesh_) mesh_ = parse_frame(read_whole_file(first), first, &polygons).mesh;
  require_same_mesh(*mesh_, first, parse_frame(bytes, file, &polygons).mesh, file);
  same_.insert(look.cells);
}

bool FrameInputs::can_begin_again() const {
  std::error_code error;
  return std::ranges::all_of(facts_, [&](const FrameFacts& facts) { return fs::is_regular_file(facts.file, error); });
}

std::optional<Frame> FrameInputs::read(std::size_t k) {
  if (k >= facts_.size()) return std::nullopt;
  Loaded loaded = take_loaded(k);
  note(k, loaded);
  load_ahead(k + 1);
  return std::move(loaded.frame);
}

FrameInputs::Loaded FrameInputs::load(std::size_t k) const {
  const std::string bytes = read_whole_file(facts_[k].file);
  if (facts_[k].looked_at && frame_hash(bytes) != facts_[k].sha256) {
    throw InputError(facts_[k].file, "",
                     "has changed since it was looked at; verify the frames again once they are complete");
  }
  Loaded loaded{{}, {rule_}, {}};
  loaded.frame = parse_frame(bytes, facts_[k].file, &loaded.polygons);
  if (!facts_[k].looked_at) loaded.facts = look_at_frame(bytes, facts_[k].file).facts;
  return loaded;
}

/// Without a thread, if none can be started.
void FrameInputs::load_ahead(std::size_t k) {
  if (!reads_ahead_ || k >= facts_.size() || !facts_[k].looked_at) return;
  const std::atomic<bool>* const stop = stop_of_thread();
  try {
    loaded_ahead_ = std::async(std::launch::async, [this, k, stop] {
      const StopOfThread stop_here(stop);
      return load(k);
    });
    ahead_ = k;
  } catch (const std::system_error&) {
    reads_ahead_ = false;
  }
}

FrameInputs::Loaded FrameInputs::take_loaded(std::size_t k) {
  std::future<Loaded> ahead = std::move(loaded_ahead_);
  return ahead.valid() && ahead_ == k ? ahead.get() : load(k);
}

std::vector<FrameFacts> FrameInputs::take_facts() {
  if (loaded_ahead_.valid()) loaded_ahead_.wait();
  return std::move(facts_);
}

void FrameInputs::note(std::size_t k, const Loaded& loaded) {
  const Frame& frame = loaded.frame;
  if (loaded.facts) facts_[k] = *loaded.facts;
  // Frames that were looked at have the same cells; if not, an error follows before they are used.
  for (FrameFacts& facts : facts_) {
    if (facts.looked_at) facts.cells = frame.mesh.cell_count();
  }
  read_[k] = true;
  polygons_ = std::max(polygons_, loaded.polygons.fans.size());
  non_planarity_ = largest_non_planarity(frame.mesh, loaded.polygons.fans, frame.positions, non_planarity_);
}

std::vector<std::string> FrameInputs::notes() const {
  std::vector<std::string> notes;
  const FrameFacts* coarsest = nullptr;
  for (const FrameFacts& facts : facts_) {
    if (facts.rounded_at && (coarsest == nullptr || *facts.rounded_at > *coarsest->rounded_at)) coarsest = &facts;
  }
  if (coarsest != nullptr) {
    const int k = *coarsest->rounded_at;
    const bool fixed = k <= 0 && coarsest->decimals == static_cast<std::uint64_t>(-k);
    const std::string text = fixed ? fmt::format("text with {} decimal{}", -k, k == -1 ? "" : "s") : coarsest->numbers;
    notes.push_back(fmt::format(
        "coordinates are {}: the verdict is exact for these numbers; their rounding may decide gaps below {}", text,
        half_of(k)));
  }
  if (polygons_ > 0) {
    const auto read = std::ranges::count(read_, true);
    const std::string where = static_cast<std::size_t>(read) == read_.size()
                                  ? std::string("all frames")
                                  : fmt::format("the {} frames that were read", read);
    notes.push_back(polygons_note(polygons_, where, non_planarity_));
  }
  return notes;
}

}  // namespace noli
