// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the readers of arrays of numpy. Input: 'S' and what comes on standard input, or 'Z' and the bytes of a .npz
// file, or 'N' and those of a .npy file. Any bytes give frames of one mesh, or an InputError of one line.
#include <unistd.h>

#include <memory>

#include "check_frame.h"
#include "tests/support/text_bytes.h"
#include "trajectory/formats/arrays/array_frames.h"
#include "trajectory/formats/arrays/stream_frames.h"

namespace {

using noli::fuzz::require;

/// A file in memory, by a name that ends so.
class MemoryFile {
 public:
  MemoryFile(std::string_view bytes, const std::string& extension) {
    name_ = "/dev/shm/noli-arrays-fuzzer-" + std::to_string(::getpid()) + extension;
    std::FILE* const file = std::fopen(name_.c_str(), "wb");
    require(file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size());
    std::fclose(file);
  }
  ~MemoryFile() { ::unlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

void check_all(noli::FrameSource& source) {
  constexpr std::size_t most = 50;  // frames may be many, and empty
  noli::Mesh mesh;
  for (std::size_t k = 0; k < most; ++k) {
    const auto frame = source.read(k);
    if (!frame) return require(!source.count() || *source.count() == k);
    noli::fuzz::check_indices(frame->mesh);
    noli::fuzz::check_positions(*frame);
    if (k == 0) mesh = frame->mesh;
    require(frame->mesh == mesh);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] == 'S') {
      noli::StreamFrames source(std::make_unique<noli::test::TextBytes>(std::string(bytes), size));
      check_all(source);
    } else if (data[0] == 'Z' || data[0] == 'N') {
      const MemoryFile file(bytes, data[0] == 'Z' ? ".npz" : ".npy");
      noli::ArrayFrames source({file.name()}, {});
      check_all(source);
    }
  } catch (const noli::InputError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}
