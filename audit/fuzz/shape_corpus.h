// SPDX-License-Identifier: Apache-2.0
//
// The corpus of a fuzzer of motions, proofs or scenes: a folder with one folder for each item of a new shape. Its file
// `shape` has that shape in one line. It is written last, so a folder that was cut off does not count.
//
// What this does not do: it does not know what the items are.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace noli::audit {

class ShapeCorpus {
 public:
  /// Precondition: the folder is there. What has no file `shape` is passed over. Throws InputError, std::system_error.
  explicit ShapeCorpus(std::filesystem::path folder);

  /// Of what is in it, ascending; behind them what was added.
  const std::vector<std::string>& names() const { return names_; }
  std::filesystem::path folder(const std::string& name) const { return folder_ / name; }

  /// Whether a shape is new; it is not from now on.
  bool reached(const std::string& shape) { return shapes_.insert(shape).second; }
  /// Adds a thing that `write` puts into an empty folder.
  void add(const std::string& shape, const std::function<void(const std::filesystem::path&)>& write);

 private:
  std::filesystem::path folder_;
  std::vector<std::string> names_;
  std::set<std::string> shapes_;
};

/// A message without what is different each time: each number is a single '#', and it is cut at 160 bytes.
std::string without_numbers(std::string_view message);

}  // namespace noli::audit
