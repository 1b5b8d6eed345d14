// SPDX-License-Identifier: Apache-2.0
//
// Frames of files that another program turns into arrays of numpy (stream_frames.h): HDF5, whose library is not made
// for hostile files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <noli/frames.h>
#include "trajectory/formats/arrays/byte_stream.h"
#include "trajectory/formats/stored_frames.h"

namespace noli {

/// The arrays of a file, on their way.
class ConvertedBytes : public ByteStream {
 public:
  /// What to know of the numbers, a line each; once all has been read.
  virtual std::vector<std::string> notes() const = 0;
};

/// Starts the program. Functions throw InputError for a file that is not as it must be; HelperError; Stopped.
class FrameConverter {
 public:
  struct Look {
    std::uint64_t frames = 0, vertices = 0, cells = 0;
    std::string numbers;         ///< "float64"
    std::uint64_t polygons = 0;  ///< that are cut
    std::string mesh;            ///< a hash of the cells
  };

  FrameConverter() = default;
  virtual ~FrameConverter() = default;
  FrameConverter(const FrameConverter&) = delete;
  FrameConverter& operator=(const FrameConverter&) = delete;

  /// Whether the file has frames of one mesh; reads no positions.
  virtual Look look(const std::filesystem::path& file, PolygonRule rule) const = 0;
  virtual std::unique_ptr<ConvertedBytes> open(const std::filesystem::path& file, PolygonRule rule) const = 0;
};

/// Whether a file is HDF5, by its extension, in any case: .vtkhdf, .hdf, .hdf5, .h5.
bool is_hdf5_name(const std::filesystem::path& path);

class StreamFrames;

class ConvertedFrames : public StoredFrames {
 public:
  /// Looks at all files. Each may have several frames. Throws what the converter throws, and OtherMesh.
  ConvertedFrames(const std::vector<std::filesystem::path>& files, std::shared_ptr<const FrameConverter> converter,
                  PolygonRule rule);
  ~ConvertedFrames() override;

  std::optional<std::size_t> count() const override;
  std::optional<Frame> read(std::size_t k) override;
  bool can_begin_again() const override { return true; }
  std::vector<std::string> notes() const override;

 private:
  /// A frame's file, and its number in it.
  struct Place {
    std::size_t file, frame;
  };

  Place place_of(std::size_t k) const;
  void open(std::size_t file);
  std::optional<Frame> next();
  void end_file(Place last);

  std::shared_ptr<const FrameConverter> converter_;
  PolygonRule rule_;
  std::vector<std::uint64_t> polygons_;          ///< by file
  std::vector<std::vector<std::string>> notes_;  ///< by file, of those that were read to their end
  std::optional<Mesh> mesh_;
  std::size_t next_ = 0;  ///< the frame that next() gives
  std::optional<std::size_t> open_file_;
  ConvertedBytes* bytes_ = nullptr;  ///< of stream_
  std::unique_ptr<StreamFrames> stream_;
};

}  // namespace noli
