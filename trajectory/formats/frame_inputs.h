// SPDX-License-Identifier: Apache-2.0
//
// The files of a sequence of frames: all looked at before the first step, each bound to its hash when it is read.
//
//   FrameInputs inputs(paths);
//   for (std::size_t k = 0; k < paths.size(); ++k) inputs.look_at(k);
//   FrameSequence sequence(inputs, motion);
//
// In memory: the file of one frame, and the cells of one mesh if files spell the same cells differently. With `ahead`,
// a thread reads the frame behind the one that was read last: it is in memory, too.
//
// look_at() opens only regular files: a look would consume the content of a pipe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/frame_source.h"
#include "trajectory/formats/polygons.h"

namespace noli {

class FrameInputs : public FrameSource {
 public:
  /// `ahead`: read the next frame in a thread, if it is a file that was looked at. Throws InputError for a frame whose
  /// extension is that of no format; the message ends with "(frame 11 of 12)".
  explicit FrameInputs(const std::vector<std::filesystem::path>& frames, PolygonRule rule = PolygonRule::fan,
                       bool ahead = false);

  std::optional<std::size_t> count() const override { return facts_.size(); }
  std::string name(std::size_t k) const override { return facts_[k].file; }

  /// Looks at frame k, if it is a regular file: header, counts, and that its cells are those of the first frame that
  /// was looked at. Throws InputError, which ends as above; ReadInterrupted.
  void look_at(std::size_t k) override;

  /// Reads frame k. Throws InputError as parse_frame does, and when the file has changed since it was looked at.
  std::optional<Frame> read(std::size_t k) override;
  /// Whether all are regular files.
  bool can_begin_again() const override;
  bool may_skip() const override { return polygons_ == 0 && same_.size() == 1 && same_.begin()->has_value(); }

  /// One per frame.
  const std::vector<FrameFacts>& facts() const override { return facts_; }
  std::vector<FrameFacts> take_facts() override;
  /// How many polygons of more than three corners a frame has at most, and their largest non-planarity (polygons.h) in
  /// all frames that were read.
  std::size_t polygons() const { return polygons_; }
  double non_planarity() const { return non_planarity_; }

  /// What to know of text and polygons, a line each.
  std::vector<std::string> notes() const override;

 private:
  /// A frame as its file has it.
  struct Loaded {
    Frame frame;
    Polygons polygons;
    std::optional<FrameFacts> facts;  ///< of a file that was not looked at
  };

  /// Changes nothing, so that another thread may do it.
  Loaded load(std::size_t k) const;
  void load_ahead(std::size_t k);
  Loaded take_loaded(std::size_t k);
  void look_at(std::size_t k, std::string_view bytes);
  void require_same_cells(std::size_t k, std::string_view bytes, const FrameLook& look);
  void note(std::size_t k, const Loaded& loaded);

  PolygonRule rule_;
  bool reads_ahead_;
  std::vector<FrameFacts> facts_;
  std::optional<std::size_t> first_;             ///< the frame with which others are compared
  std::set<std::optional<std::uint64_t>> same_;  ///< spellings of its cells
  std::optional<Mesh> mesh_;                     ///< its cells, once they had to be parsed
  std::vector<bool> read_;                       ///< of each frame
  std::size_t polygons_ = 0;
  double non_planarity_ = 0;
  std::size_t ahead_ = 0;             ///< the frame that is being read ahead
  std::future<Loaded> loaded_ahead_;  ///< the last member, as its destructor waits for the thread
};

}  // namespace noli
