// SPDX-License-Identifier: Apache-2.0
//
// Frames from standard input or another stream: arrays of numpy one after another, as np.save writes them in a loop.
//
//   cells first, integers (m, 3), (m, 2) or (m,), as many arrays as there are; then for each frame its positions, real
//   numbers (n, 3) or (n, 2)
//
// How many frames there are is known when the stream ends. It is read once.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/formats/arrays/npy.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

class StreamFrames : public FrameSource {
 public:
  /// Reads nothing yet. `file`: what the stream is called; -: standard input.
  explicit StreamFrames(std::unique_ptr<ByteStream> bytes, std::string file = "-");
  ~StreamFrames() override;

  std::optional<std::size_t> count() const override { return std::nullopt; }
  std::string name(std::size_t k) const override;
  void look_at(std::size_t /*k*/) override {}
  std::optional<Frame> read(std::size_t k) override;
  bool can_begin_again() const override { return false; }
  const std::vector<FrameFacts>& facts() const override { return facts_; }
  std::vector<std::string> notes() const override { return {}; }

 private:
  class Hashed;

  std::optional<NpyHeader> next_array();
  /// What messages call an array: "standard input, array 3"; in other streams nobody counts arrays.
  std::string array_name(std::size_t array) const;
  std::string array_name() const { return array_name(arrays_); }
  void read_cells();
  void require_frame(const NpyHeader& header) const;
  std::optional<Frame> next_frame();

  std::unique_ptr<Hashed> bytes_;
  std::string stream_;              ///< "standard input"
  std::vector<FrameFacts> facts_;   ///< one
  std::optional<NpyHeader> first_;  ///< of frame 0, when cells have been read
  Mesh mesh_;
  std::size_t arrays_ = 0, frames_ = 0;
};

}  // namespace noli
