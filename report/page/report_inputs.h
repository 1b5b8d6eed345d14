// SPDX-License-Identifier: Apache-2.0
//
// Whether a result of `noli verify` or `noli repair` is about the very files that a report shows: by SHA-256.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "certify/json.h"
#include "trajectory/formats/frame_look.h"

namespace noli::report {

/// How the frames of a result were read: names of arrays, and bodies with their files. Throws nlohmann::json::exception
/// where members are not as noli writes them.
FrameReading reading_of(const Json& inputs, const Json& bodies);

class ResultInputs {
 public:
  /// `inputs`: that member of a result, or others with file and hash. `command`: the one that wrote it. Throws
  /// InputError when the result does not name the hashes of what it is about, as those of older versions.
  ResultInputs(Json inputs, const std::filesystem::path& path, std::string_view command = "verify");

  /// Throws InputError unless each file that was looked at has the bytes of the input with the same number.
  void require_files(const std::vector<FrameFacts>& read) const;

  /// Throws InputError unless the files of the run are those of the result; ReadInterrupted.
  void require_run(const std::filesystem::path& run) const;

 private:
  void require_file(std::size_t k, const FrameFacts& read) const;
  [[noreturn]] void refuse(const std::string& what) const;

  const std::filesystem::path& path_;
  Json inputs_;
  std::string advice_;
};

}  // namespace noli::report
