// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/converted_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include <noli/errors.h>
#include "trajectory/formats/arrays/stream_frames.h"
#include "trajectory/formats/frames.h"

namespace noli {

bool is_hdf5_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 4> extensions = {".vtkhdf", ".hdf", ".hdf5", ".h5"};
  return std::ranges::count(extensions, extension_of(path)) > 0;
}

ConvertedFrames::ConvertedFrames(const std::vector<std::filesystem::path>& files,
                                 std::shared_ptr<const FrameConverter> converter, PolygonRule rule)
    : StoredFrames(files), converter_(std::move(converter)), rule_(rule), notes_(files.size()) {
  std::string mesh;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!is_hdf5_name(files[i])) {
      throw InputError(files[i].string(), "", "is not HDF5 by its name, but files before it are; expected one kind");
    }
    const FrameConverter::Look look = converter_->look(files[i], rule_);
    FrameFacts& facts = facts_of(i);
    facts.frames = look.frames;
    facts.numbers = look.numbers;
    facts.vertices = look.vertices;
    facts.cells = look.cells;
    polygons_.push_back(look.polygons);
    if (i == 0) mesh = look.mesh;
    const FrameFacts& first = facts_of(0);
    if (look.vertices == first.vertices && look.mesh == mesh) continue;
    throw OtherMesh(facts.file, "",
                    fmt::format("has {} vertices and {} cells, which are not those of {}, {} and {}; all frames must "
                                "have the same mesh",
                                look.vertices, look.cells, first.file, first.vertices, *first.cells));
  }
}

ConvertedFrames::~ConvertedFrames() = default;

std::optional<std::size_t> ConvertedFrames::count() const { return frame_count(facts()); }

ConvertedFrames::Place ConvertedFrames::place_of(std::size_t k) const {
  std::size_t file = 0;
  for (; file + 1 < facts().size() && k >= facts()[file].frames; ++file) k -= facts()[file].frames;
  return {file, k};
}

std::vector<std::string> ConvertedFrames::notes() const {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < facts().size(); ++i) {
    const std::string of = facts().size() == 1 ? "" : facts()[i].file + ": ";
    for (const std::string& note : notes_[i]) notes.push_back(of + note);
    if (polygons_[i] > 0 && notes_[i].empty()) {
      notes.push_back(
          fmt::format("{}polygons of more than three corners are cut into fans of triangles: {}", of, polygons_[i]));
    }
  }
  return notes;
}

void ConvertedFrames::open(std::size_t file) {
  auto bytes = converter_->open(facts()[file].file, rule_);
  bytes_ = bytes.get();
  stream_ = std::make_unique<StreamFrames>(std::move(bytes), facts()[file].file);
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
  look_at(next_);  // a source need not have been looked at
  if (open_file_ != place.file) open(place.file);
  const FrameFacts& facts_of_file = facts()[place.file];
  std::optional<Frame> frame = stream_->read(place.frame);
  require_unchanged(place.file);
  if (!frame) {
    throw InputError(facts_of_file.file, "",
                     fmt::format("has {} frames; expected {}", place.frame, facts_of_file.frames));
  }
  if (!mesh_) mesh_ = frame->mesh;
  require_same_mesh(*mesh_, facts()[0].file, frame->mesh, facts_of_file.file);
  if (place.frame + 1 == facts_of_file.frames) end_file(place);
  ++next_;
  return frame;
}

void ConvertedFrames::end_file(Place last) {
  const FrameFacts& file = facts()[last.file];
  if (stream_->read(last.frame + 1))
    throw InputError(file.file, "", fmt::format("has more than {} frames", file.frames));
  notes_[last.file] = bytes_->notes();
  if (next_ + 1 == count()) require_same_bytes();
}

}  // namespace noli
