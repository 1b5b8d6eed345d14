// SPDX-License-Identifier: Apache-2.0
#include "app/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <noli/errors.h>
#include "certify/result_file.h"
#include "certify/runs/run_folder.h"
#include "integrator/scene/read_scene.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const OutputFile& output, const std::string& problem) {
  throw UsageError(output.option + " " + output.path.string() + ": " + problem);
}

/// By name, or by device and inode.
bool one_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return place_of(a) == place_of(b) || fs::equivalent(a, b, error);
}

/// Whether standard output goes to this very file (a terminal or pipe may take both).
bool is_standard_output(const fs::path& path) {
  struct stat file = {}, out = {};
  if (::stat(path.c_str(), &file) != 0 || ::fstat(STDOUT_FILENO, &out) != 0) return false;
  return S_ISREG(file.st_mode) && file.st_dev == out.st_dev && file.st_ino == out.st_ino;
}

void require_file(const OutputFile& output) {
  std::error_code error;
  if (fs::is_directory(output.path, error)) refuse(output, "is a folder; expected a file");
  if (is_standard_output(output.path)) refuse(output, "standard output goes there; expected another file, or '-'");
}

void require_regular(const OutputFile& output) {
  std::error_code error;
  const bool regular = is_regular_or_nothing(output.path) && !fs::is_symlink(output.path, error);
  if (output.only_files && !regular) refuse(output, "is not a regular file; expected the name of a file");
}

void require_not_read(const OutputFile& output, const fs::path& input) {
  if (one_file(output.path, input)) refuse(output, "is also an input; expected another file");
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(input, error)) {
    if (entry.is_regular_file(error) && one_file(output.path, entry.path())) {
      refuse(output, "is also an input; expected another file");
    }
  }
}

/// `runs`: folders that hold a run, or will.
void require_not_of_run(const OutputFile& output, const std::vector<fs::path>& runs) {
  const fs::path place = place_of(output.path), folder = place.parent_path();
  std::error_code error;
  bool in_run = fs::exists(folder / "trajectory.blocks", error);
  for (const fs::path& run : runs) in_run = in_run || place_of(run) == folder;
  if (in_run && is_file_of_run(place.filename())) {
    refuse(output, "is a file of the run in that folder; expected another name");
  }
}

void require_new(const OutputFile& output, bool force) {
  std::error_code error;
  const bool there = fs::exists(fs::symlink_status(output.path, error));
  if (!there || force || !is_regular_or_nothing(output.path)) return;
  refuse(output, "exists already; choose another name, or pass --force");
}

}  // namespace

std::vector<OutputFile> outputs(const std::string& option, const std::optional<std::string>& path) {
  if (!path) return {};
  return {{option, *path}};
}

std::vector<fs::path> inputs_of_scene(const fs::path& scene) {
  std::vector<fs::path> inputs = {scene};
  std::error_code error;
  if (!fs::is_regular_file(scene, error)) return inputs;  // a pipe is read once
  try {
    for (const fs::path& file : integrator::files_of(integrator::read_scene(scene))) inputs.push_back(file);
  } catch (const InputError&) {
  }
  return inputs;
}

void require_output_files(const std::vector<OutputFile>& outputs, const std::vector<fs::path>& inputs, bool force) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    if (output.path == "-") continue;
    require_file(output);
    for (const fs::path& input : inputs) require_not_read(output, input);
    require_not_of_run(output, inputs);
    for (std::size_t k = 0; k < i; ++k) {
      if (outputs[k].path != "-" && is_regular_or_nothing(output.path) && one_file(outputs[k].path, output.path)) {
        refuse(output, "is where " + outputs[k].option + " goes; expected another file");
      }
    }
    require_regular(output);
    require_new(output, force);
    require_writable_file(output.path, output.option);
  }
}

}  // namespace noli::app
