// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "certify/runs/run_folder.h"
#include "report/input_report.h"
#include "trajectory/stop.h"

namespace noli::report {
namespace {

bool is_hash(const Json& value) { return value.is_string() && value.get_ref<const std::string&>().size() == 64; }

std::string member(const Json& input, const char* key) {
  const Json value = input.is_object() ? input.value(key, Json()) : Json();
  return value.is_string() ? value.get<std::string>() : "";
}

/// Enough of a hash to tell it from another by eye.
std::string shortened(const std::string& hash) { return hash.substr(0, 12) + "..."; }

}  // namespace

FrameReading reading_of(const Json& inputs, const Json& bodies) {
  FrameReading reading;
  if (inputs.size() == 1) reading.keys = inputs[0].value("arrays", Json::array()).get<std::vector<std::string>>();
  for (const Json& body : bodies) {
    BodyFrames frames{body.at("name").get<std::string>(), {}, body.at("still").get<bool>()};
    for (const Json& input : inputs) {
      if (member(input, "body") == frames.name) frames.frames.emplace_back(member(input, "file"));
    }
    reading.bodies.push_back(std::move(frames));
  }
  return reading;
}

ResultInputs::ResultInputs(Json inputs, const std::filesystem::path& path, std::string_view command)
    : path_(path),
      inputs_(std::move(inputs)),
      advice_(fmt::format("; {} what is shown, with --json, and report that result", command)) {
  const bool hashes = inputs_.is_array() && !inputs_.empty() && std::ranges::any_of(inputs_, [](const Json& input) {
                        return input.is_object() && is_hash(input.value("sha256", Json()));
                      });
  if (!hashes) refuse(std::string("does not say what it is about: \"inputs\" with SHA-256 is missing") + advice_);
}

void ResultInputs::refuse(const std::string& what) const { throw InputError(path_.string(), "", what); }

void ResultInputs::require_files(const std::vector<FrameFacts>& read) const {
  for (std::size_t k = 0; k < read.size(); ++k) {
    if (read[k].looked_at) require_file(k, read[k]);
  }
}

void ResultInputs::require_file(std::size_t k, const FrameFacts& read) const {
  const Json input = k < inputs_.size() ? inputs_.at(k) : Json();
  const std::string expected = member(input, "sha256"), found = hex(read.sha256);
  if (expected == found) return;
  if (expected.empty()) refuse(fmt::format("has no SHA-256 of frame {}, which it did not read{}", k + 1, advice_));
  refuse(fmt::format("is about other frames: frame {} was {} with SHA-256 {}, but {} has {}{}", k + 1,
                     member(input, "file"), shortened(expected), read.file, shortened(found), advice_));
}

void ResultInputs::require_run(const std::filesystem::path& run) const {
  for (const FrameFacts& facts : run_facts(run, [] { return stop_asked().has_value(); })) {
    const std::string name = std::filesystem::path(facts.file).filename().string(), found = hex(facts.sha256);
    const auto input = std::ranges::find_if(
        inputs_, [&](const Json& of) { return std::filesystem::path(member(of, "file")).filename() == name; });
    const std::string expected = input == inputs_.end() ? "" : member(*input, "sha256");
    if (expected.empty()) refuse(fmt::format("has no SHA-256 of {}{}", name, advice_));
    if (expected == found) continue;
    refuse(fmt::format("is about another run, or about less of this one: its {} had SHA-256 {}, but {} has {}{}", name,
                       shortened(expected), facts.file, shortened(found), advice_));
  }
}

}  // namespace noli::report
