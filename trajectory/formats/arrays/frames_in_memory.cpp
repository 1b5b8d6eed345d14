// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/frames_in_memory.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

#include <noli/errors.h>

namespace noli {

static_assert(std::endian::native == std::endian::little, "doubles are hashed as they are in memory");

FramesInMemory::FramesInMemory(std::string called, std::shared_ptr<const GivenFrames> given)
    : called_(std::move(called)), given_(std::move(given)), facts_(1), passes_(1) {
  facts_[0].file = called_;
  facts_[0].numbers = given_->numbers;
  facts_[0].vertices = given_->mesh.vertex_count;
  facts_[0].cells = given_->mesh.cell_count();
  facts_[0].frames = given_->count.value_or(0);
}

std::string FramesInMemory::name(std::size_t k) const { return fmt::format("{}[{}]", called_, k); }

std::optional<Frame> FramesInMemory::read(std::size_t k) {
  if (given_->count && k >= *given_->count) return std::nullopt;
  auto given = given_->frame(k);
  if (!given) return std::nullopt;
  Frame frame{given_->mesh, positions_of(k, *std::move(given))};
  if (k == 0 && passes_.back().frames > 0) passes_.emplace_back();
  if (k == passes_.back().frames) add(frame.positions);
  return frame;
}

void FramesInMemory::add(const std::vector<Position>& positions) {
  Pass& pass = passes_.back();
  const std::string_view bytes(reinterpret_cast<const char*>(positions.data()), positions.size() * sizeof(Position));
  pass.hash.update(bytes);
  pass.bytes += bytes.size();
  ++pass.frames;
}

std::vector<Position> FramesInMemory::positions_of(std::size_t k, std::vector<Position> given) const {
  const std::size_t expected = given_->mesh.vertex_count;
  if (given.size() != expected) {
    throw InputError(name(k), "",
                     fmt::format("has {} positions; expected {}, one for each vertex", given.size(), expected));
  }
  for (std::size_t v = 0; v < given.size(); ++v) {
    for (const double x : given[v]) {
      if (std::isfinite(x)) continue;
      throw InputError(name(k), fmt::format("vertex {}", v), fmt::format("expected a finite number, found {}", x));
    }
  }
  return given;
}

std::vector<FrameFacts> FramesInMemory::take_facts() {
  while (given_->again && passes_.back().frames < given_->count.value_or(0)) {
    const std::size_t k = passes_.back().frames;
    auto given = given_->frame(k);
    if (!given) break;
    add(positions_of(k, *std::move(given)));
  }
  const Pass& last = passes_.back();
  for (const Pass& pass : passes_) {
    if (pass.frames != last.frames || pass.hash.digest() == last.hash.digest()) continue;
    throw InputError(called_, "", "has changed while it was read; expected frames that stay as they are");
  }
  facts_[0].looked_at = true;
  facts_[0].frames = last.frames;
  facts_[0].bytes = last.bytes;
  facts_[0].sha256 = last.hash.digest();
  return facts_;
}

}  // namespace noli
