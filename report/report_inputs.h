// SPDX-License-Identifier: Apache-2.0
//
// Whether a result of `noli verify` is about the very files that a report shows: by SHA-256.
#pragma once

#include <cstddef>
#include <filesystem>

#include "certify/json.h"
#include "trajectory/formats/frame_look.h"

namespace noli::report {

class ResultInputs {
 public:
  /// Throws InputError when the result does not name the hashes of what it is about, as those of older versions.
  ResultInputs(const Json& result, const std::filesystem::path& path);

  /// Throws InputError unless frame k of the result, from 0, has the bytes that were read.
  void require_frame(std::size_t k, const FrameFacts& read) const;

  /// Throws InputError unless the files of the run are those of the result; ReadInterrupted.
  void require_run(const std::filesystem::path& run) const;

 private:
  [[noreturn]] void refuse(const std::string& what) const;

  const std::filesystem::path& path_;
  Json inputs_;
};

}  // namespace noli::report
