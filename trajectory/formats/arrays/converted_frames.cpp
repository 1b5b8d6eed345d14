// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/converted_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <noli/errors.h>
#include "trajectory/formats/arrays/stream_frames.h"
#include "trajectory/formats/frames.h"

namespace noli {
namespace {

Sha256Digest hash_of_file(const std::filesystem::path& file, std::uint64_t& size) {
  FileBytes bytes(file);
  Sha256 hash;
  size = 0;
  std::vector<char> part(std::size_t{1} << 20);
  while (const std::size_t got = bytes.read_all(part.data(), part.size())) {
    hash.update({part.data(), got});
    size += got;
  }
  return hash.digest();
}

}  // namespace

bool is_hdf5_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 4> extensions = {".vtkhdf", ".hdf", ".hdf5", ".h5"};
  return std::ranges::count(extensions, extension_of(path)) > 0;
}

ConvertedFrames::ConvertedFrames(const std::vector<std::filesystem::path>& files,
                                 std::shared_ptr<const FrameConverter> converter, PolygonRule rule)
    : converter_(std::move(converter)), rule_(rule), facts_(files.size()), notes_(files.size()) {
  std::string mesh;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!is_hdf5_name(files[i])) {
      throw InputError(files[i].string(), "", "is no HDF5 by its name, and files before it are; expected one kind");
    }
    const FrameConverter::Look look = converter_->look(files[i], rule_);
    FrameFacts& facts = facts_[i];
    facts.file = files[i].string();
    facts.frames = look.frames;
    facts.numbers = look.numbers;
    facts.vertices = look.vertices;
    facts.cells = look.cells;
    polygons_.push_back(look.polygons);
    if (i == 0) mesh = look.mesh;
    if (look.vertices == facts_[0].vertices && look.mesh == mesh) continue;
    throw OtherMesh(facts.file, "",
                    fmt::format("has {} vertices and {} cells, which are not those of {}, {} and {}; all frames must "
                                "have the same mesh",
                                look.vertices, look.cells, facts_[0].file, facts_[0].vertices, *facts_[0].cells));
  }
}

ConvertedFrames::~ConvertedFrames() = default;

std::optional<std::size_t> ConvertedFrames::count() const {
  return std::accumulate(facts_.begin(), facts_.end(), std::size_t{0},
                         [](std::size_t sum, const FrameFacts& facts) { return sum + facts.frames; });
}

ConvertedFrames::Place ConvertedFrames::place_of(std::size_t k) const {
  std::size_t file = 0;
  for (; file + 1 < facts_.size() && k >= facts_[file].frames; ++file) k -= facts_[file].frames;
  return {file, k};
}

std::string ConvertedFrames::name(std::size_t k) const {
  const Place place = place_of(k);
  const FrameFacts& facts = facts_[place.file];
  return facts.frames == 1 ? facts.file : fmt::format("{}[{}]", facts.file, place.frame);
}

std::vector<std::string> ConvertedFrames::notes() const {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < facts_.size(); ++i) {
    const std::string of = facts_.size() == 1 ? "" : facts_[i].file + ": ";
    for (const std::string& note : notes_[i]) notes.push_back(of + note);
    if (polygons_[i] > 0 && notes_[i].empty()) {
      notes.push_back(
          fmt::format("{}polygons of more than three corners are cut into fans of triangles: {}", of, polygons_[i]));
    }
  }
  return notes;
}

void ConvertedFrames::look_at(std::size_t k) {
  const Place place = place_of(k);
  if (!facts_[place.file].looked_at) look_at_file(place.file);
}

void ConvertedFrames::look_at_file(std::size_t file) {
  FrameFacts& facts = facts_[file];
  facts.sha256 = hash_of_file(facts.file, facts.bytes);
  facts.looked_at = true;
}

void ConvertedFrames::require_unchanged(std::size_t file) const {
  std::uint64_t size = 0;
  if (hash_of_file(facts_[file].file, size) == facts_[file].sha256) return;
  throw InputError(facts_[file].file, "",
                   "has changed since it was looked at; verify the frames again once they are complete");
}

void ConvertedFrames::open(std::size_t file) {
  if (!facts_[file].looked_at) look_at_file(file);
  auto bytes = converter_->open(facts_[file].file, rule_);
  bytes_ = bytes.get();
  stream_ = std::make_unique<StreamFrames>(std::move(bytes), facts_[file].file);
  open_file_ = file;
}

std::optional<Frame> ConvertedFrames::read(std::size_t k) {
  if (k >= count()) return std::nullopt;
  if (k < next_) {
    next_ = 0;
    open_file_.reset();
  }
  std::optional<Frame> frame;
  while (next_ <= k) frame = next();
  return frame;
}

std::optional<Frame> ConvertedFrames::next() {
  const Place place = place_of(next_);
  if (open_file_ != place.file) open(place.file);
  const FrameFacts& facts = facts_[place.file];
  std::optional<Frame> frame = stream_->read(place.frame);
  if (!frame) throw InputError(facts.file, "", fmt::format("has {} frames; expected {}", place.frame, facts.frames));
  if (!mesh_) mesh_ = frame->mesh;
  require_same_mesh(*mesh_, facts_[0].file, frame->mesh, facts.file);
  if (place.frame + 1 == facts.frames) {
    if (stream_->read(place.frame + 1)) {
      throw InputError(facts.file, "", fmt::format("has more than {} frames", facts.frames));
    }
    notes_[place.file] = bytes_->notes();
    require_unchanged(place.file);
  }
  ++next_;
  return frame;
}

}  // namespace noli
