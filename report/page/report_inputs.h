// SPDX-License-Identifier: Apache-2.0
//
// Whether a result of `noli verify` is about the very files that a report shows: by SHA-256.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "certify/json.h"
#include "trajectory/formats/frame_look.h"

namespace noli::report {

/// How the frames of a result were read: names of arrays, and bodies with their files. Throws nlohmann::json::exception
/// where members are not as `noli verify` writes them.
FrameReading reading_of(const Json& result);

class ResultInputs {
 public:
  /// Throws InputError when the result does not name the hashes of what it is about, as those of older versions.
  ResultInputs(const Json& result, const std::filesystem::path& path);

  /// Throws InputError unless each file that was looked at has the bytes of the input with the same number.
  void require_files(const std::vector<FrameFacts>& read) const;

  /// Throws InputError unless the files of the run are those of the result; ReadInterrupted.
  void require_run(const std::filesystem::path& run) const;

 private:
  void require_file(std::size_t k, const FrameFacts& read) const;
  [[noreturn]] void refuse(const std::string& what) const;

  const std::filesystem::path& path_;
  Json inputs_;
};

}  // namespace noli::report
