// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_names.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <noli/errors.h>
#include <noli/frames.h>
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/vtk/pvd.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

Paths sorted_by_numbers(Paths files) {
  std::ranges::sort(files);
  return order_frames(std::move(files), FrameOrder::natural).frames;
}

/// The files in a folder whose names are wanted.
template <class Wanted>
Paths files_of(const fs::path& folder, const fs::path& given, const Wanted& wanted) {
  Paths files;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end; at.increment(error)) {
    end_if_stopped();
    const fs::path name = at->path().filename();
    std::error_code ignored;
    if (wanted(name) && !fs::is_directory(at->path(), ignored)) files.push_back(folder / name);
  }
  if (error) throw InputError(given.string(), "", "cannot be listed: " + error.message());
  return files;
}

Paths of_folder(const fs::path& folder) {
  // Not .h5: the folder of a run has its series.h5.
  const auto has_frames = [](const fs::path& name) { return is_frame_name(name) || extension_of(name) == ".vtkhdf"; };
  Paths files = files_of(folder, folder,
                         [&](const fs::path& name) { return has_frames(name) && !name.string().starts_with('.'); });
  if (files.empty()) return {folder};  // perhaps a run that nobody has written to yet
  files = sorted_by_numbers(std::move(files));
  const std::string extension = extension_of(files.front());
  const auto other = std::ranges::find_if(files, [&](const fs::path& file) { return extension_of(file) != extension; });
  if (other == files.end()) return files;
  throw InputError(
      folder.string(), "",
      fmt::format("has frames of two formats, {} and {}; name those you mean: '{}'", files.front().filename().string(),
                  other->filename().string(), (folder / ("*" + extension)).string()));
}

/// "%04d" in a name: what stands before and behind it, and how many digits it has at least.
struct NumberPattern {
  std::string before, after;
  std::size_t width = 0;

  bool matches(const std::string& name) const {
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
      return false;
    const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
    const bool number = digits.find_first_not_of("0123456789") == std::string::npos;
    const bool padded = digits.size() > 1 && digits[0] == '0';
    return number && digits.size() >= width && (!padded || digits.size() == width);
  }
};

std::optional<NumberPattern> number_pattern(const std::string& name) {
  const std::size_t percent = name.find('%'), d = name.find('d', percent);
  if (percent == std::string::npos || d == std::string::npos) return std::nullopt;
  const std::string width = name.substr(percent + 1, d - percent - 1);
  if (width.find_first_not_of("0123456789") != std::string::npos || width.size() > 3) return std::nullopt;
  if (!width.empty() && width[0] != '0') return std::nullopt;
  return NumberPattern{name.substr(0, percent), name.substr(d + 1), width.empty() ? 1 : std::stoul(width)};
}

Paths of_pattern(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  const auto number = number_pattern(name);
  Paths files = files_of(pattern.parent_path(), pattern, [&](const fs::path& file) {
    return number ? number->matches(file.string()) : ::fnmatch(name.c_str(), file.c_str(), FNM_PERIOD) == 0;
  });
  if (files.empty()) throw InputError(pattern.string(), "", "matches no file");
  return sorted_by_numbers(std::move(files));
}

Paths of_list(const fs::path& list) {
  Paths files;
  const std::string text = read_whole_file(list);
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    if (!line.empty() && line.front() != '#') files.push_back(list.parent_path() / fs::path(line));
  }
  if (files.empty()) throw InputError(list.string(), "", "names no frame; expected a path on each line");
  return files;
}

bool is_pattern(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.find_first_of("*?[") != std::string::npos || number_pattern(name).has_value();
}

}  // namespace

Paths named_frames(Paths given) {
  Paths files;
  files.reserve(given.size());
  const auto add = [&](Paths more) { std::ranges::move(more, std::back_inserter(files)); };
  for (fs::path& name : given) {
    std::error_code error;
    if (name.string().starts_with('@')) {
      add(of_list(name.string().substr(1)));
    } else if (fs::is_directory(name, error) && !fs::exists(trajectory_path(name), error)) {
      add(of_folder(name));
    } else if (extension_of(name) == ".pvd") {
      add(files_of_pvd(name));
    } else if (!fs::exists(fs::symlink_status(name, error)) && is_pattern(name)) {
      add(of_pattern(name));
    } else {
      files.push_back(std::move(name));
    }
  }
  return files;
}

Paths files_named(const Paths& given) {
  Paths files;
  for (const fs::path& name : given) {
    const std::string text = name.string();
    if (text.starts_with('@')) files.emplace_back(text.substr(1));
    if (extension_of(name) == ".pvd") files.push_back(name);
  }
  return files;
}

void order_bodies(std::vector<BodyFrames>& bodies, FrameOrder order, std::vector<std::string>& notes) {
  for (BodyFrames& body : bodies) {
    OrderedFrames ordered = order_frames(std::move(body.frames), order);
    body.frames = std::move(ordered.frames);
    for (const std::string& note : ordered.notes) notes.push_back(body.name + ": " + note);
  }
}

std::vector<std::filesystem::path> files_of(const std::vector<BodyFrames>& bodies) {
  std::vector<std::filesystem::path> files;
  for (const BodyFrames& body : bodies) files.insert(files.end(), body.frames.begin(), body.frames.end());
  return files;
}

void require_there(const std::vector<std::filesystem::path>& frames) {
  std::error_code error;
  if (frames.size() != 1 || frames[0] == "-" || std::filesystem::exists(std::filesystem::status(frames[0], error)))
    return;
  throw InputError(frames[0].string(), "", "cannot be opened: there is no such file or folder");
}

}  // namespace noli
