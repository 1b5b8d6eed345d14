// SPDX-License-Identifier: Apache-2.0
//
// A text as a stream of bytes, which come in parts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "trajectory/formats/arrays/byte_stream.h"

namespace noli::test {

class TextBytes : public ByteStream {
 public:
  /// `most`: bytes of a part.
  explicit TextBytes(std::string text, std::size_t most = 7) : text_(std::move(text)), most_(most) {}
  std::size_t read(char* to, std::size_t size) override {
    const std::size_t part = std::min({size, most_, text_.size() - at_});
    text_.copy(to, part, at_);
    at_ += part;
    return part;
  }

 private:
  std::string text_;
  std::size_t at_ = 0, most_;
};

}  // namespace noli::test
