// SPDX-License-Identifier: Apache-2.0
//
// Frames in files of numpy: one .npz, or .npy files (arrays/array_choice.h).
//
// Frames of an array in the order of C are read one after another. In the order of Fortran the numbers of a frame are
// all over the array, so it is read once for each 256 MB of frames.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/formats/arrays/array_choice.h"
#include "trajectory/formats/arrays/npz.h"
#include "trajectory/formats/stored_frames.h"

namespace noli {

/// Whether a file is one of numpy, by its name.
bool is_array_name(const std::filesystem::path& path);

class ArrayFrames : public StoredFrames {
 public:
  /// Reads headers and cells. Throws InputError. Precondition: one .npz, or .npy files.
  ArrayFrames(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& keys);

  std::optional<std::size_t> count() const override { return chosen_.frames; }
  std::optional<Frame> read(std::size_t k) override;
  std::vector<std::string> notes() const override;

 private:
  void add_npz(const std::filesystem::path& file);
  void add_npy(const std::filesystem::path& file, std::size_t number);
  void require_others_whole() const;
  void read_mesh();
  void describe();
  std::vector<double> numbers_of_frame(std::size_t k);
  std::vector<double> next_in_order(const StoredArray& array, std::size_t k);
  void load_columns(const StoredArray& array, std::size_t first);

  std::unique_ptr<NpzFile> archive_;
  std::vector<StoredArray> arrays_;
  ChosenArrays chosen_;
  Mesh mesh_;
  std::unique_ptr<ByteStream> stream_;  ///< of the positions, at frame next_
  std::size_t next_ = 0;
  std::vector<double> columns_;  ///< of an array in the order of Fortran: frames from columns_first_ on
  std::size_t columns_first_ = 0, columns_count_ = 0;
};

}  // namespace noli
