// SPDX-License-Identifier: Apache-2.0
#include "app/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <noli/errors.h>
#include "app/help.h"
#include "trajectory/formats/frame_names.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

/// "shirt=shirt_*.obj"
BodyFrames parsed(const std::string& word, const char* option) {
  const std::size_t at = word.find('=');
  if (at == 0 || at == std::string::npos || at + 1 == word.size()) {
    throw UsageError(
        fmt::format("{} {}: expected a name and its files, such as shirt=shirt_*.obj", option, on_one_line(word)));
  }
  return {word.substr(0, at), named_frames({word.substr(at + 1)}), false};
}

/// "floor.obj" is the body "floor".
BodyFrames obstacle(const std::string& word) {
  BodyFrames body;
  if (word.find('=') != std::string::npos) {
    body = parsed(word, "--obstacle");
  } else {
    body = {fs::path(word).stem().string(), named_frames({word}), false};
  }
  body.still = true;
  return body;
}

}  // namespace

void add_body_options(CLI::App& command, BodyArguments& arguments, CLI::Option* frames) {
  CLI::Option* const body =
      command.add_option("--body", arguments.bodies, "A body and its files, once for each body; joined into one mesh")
          ->allow_extra_args(false)
          ->type_name("NAME=FRAMES")
          ->group(group::question);
  CLI::Option* const still =
      command.add_option("--obstacle", arguments.obstacles, "A body that stands still, with --body: one file")
          ->allow_extra_args(false)
          ->needs(body)
          ->type_name("[NAME=]FRAME")
          ->group(group::question);
  if (frames == nullptr) return;
  body->excludes(frames);
  still->excludes(frames);
}

std::vector<BodyFrames> bodies_of(const BodyArguments& arguments, FrameOrder order, std::vector<std::string>& notes) {
  std::vector<BodyFrames> bodies;
  for (const std::string& word : arguments.bodies) bodies.push_back(parsed(word, "--body"));
  for (const std::string& word : arguments.obstacles) bodies.push_back(obstacle(word));
  order_bodies(bodies, order, notes);
  return bodies;
}

}  // namespace noli::app
