// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/proof_checkers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/trajectories/frame_motion.h"
#include "certify/process/scratch_folder.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> extensions = {"ply", "obj", "blocks"};  // of a trajectory

std::string trajectory_name(const ProofFiles& files, std::size_t i) {
  if (files.extension == "blocks") return "trajectory.blocks";
  return fmt::format("trajectory-{}.{}", i, files.extension);
}

constexpr const char* proof_name = "proof.noli";

/// Frames behind a gap, or a second trajectory: of the folder, `files` is what was read.
void require_nothing_else(const fs::path& folder, const ProofFiles& files) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const auto number = name == "trajectory.blocks" ? 0 : frame_number(entry.path(), "trajectory-");
    if (!number || (*number < files.files.size() && name == trajectory_name(files, *number))) continue;
    const bool gap = *number >= files.files.size() && files.extension != "blocks";
    const std::string other = trajectory_name(files, gap ? files.files.size() : *number);
    throw InputError(folder.string(), "",
                     gap ? fmt::format("has {}, but no {}", name, other)
                         : fmt::format("has both {} and {}; expected one of them", name, other));
  }
}

/// Removes from a folder with these files what it has of a longer trajectory, or of one of another form.
void remove_other_frames(const ProofFiles& files, const fs::path& folder) {
  for (const char* const extension : extensions) {
    const bool same = extension == files.extension;
    if (same && files.extension == "blocks") continue;
    for (std::size_t i = same ? files.files.size() : 0; fs::remove(folder / trajectory_name({"", extension, {}}, i));
         ++i) {
    }
  }
}

/// A device would be read until memory is full.
std::string read_regular_file(const fs::path& file) {
  if (fs::exists(file) && !fs::is_regular_file(file))
    throw InputError(file.string(), "", "is not a regular file; expected one that was saved");
  return read_whole_file(file);
}

ProofAnswer answer_of(int code) {
  if (code == 0 || code == 1 || code == 3) return {code, "", ""};
  return {code, fmt::format("exit code {}", code), ""};
}

/// Records as noli_check_host reads them.
std::string name_record(const std::string& name) { return static_cast<char>(name.size()) + name; }

std::string file_record(const std::string& name, const std::string& data) {
  std::string record = "F" + name_record(name);
  put(record, static_cast<std::uint32_t>(data.size()));
  return record + data;
}

class HostedChecker : public ProofChecker {
 public:
  HostedChecker(fs::path host, std::chrono::milliseconds limit)
      : program_(std::move(host)), limits_{.time = limit, .to_end = {}} {
    start();
  }

  ProofAnswer check(const ProofFiles& files) override {
    const std::vector<std::string> asked = own_claim(files.proof);
    std::string records = file_record(proof_name, files.proof), run = "W";
    run += static_cast<char>(2 * asked.size() + 1 + files.files.size());
    for (const std::string& field : asked) run += name_record("--require") + name_record(field);
    run += name_record(proof_name);
    for (std::size_t i = 0; i < files.files.size(); ++i) {
      records += file_record(trajectory_name(files, i), files.files[i]);
      run += name_record(trajectory_name(files, i));
    }
    host_->write(records + run, limits_);  // what it does not read it does not answer
    if (auto answer = receive()) return std::move(*answer);
    ProofAnswer answer{-1, last_words(), ""};
    start();
    return answer;
  }

 private:
  void start() {
    host_.emplace(std::vector{program_.string(), folder_.path().string()},
                  Child::Descriptors{.in = Child::piped, .out = Child::piped, .err = Child::shared});
  }

  /// How it ended.
  std::string last_words() {
    if (!host_->silent()) return "no answer within the time limit";
    const ProgramEnd end = host_->finish(limits_);
    return end.kind == ProgramEnd::Kind::exited ? fmt::format("its host ended with code {}", end.code) : end.words();
  }

  std::optional<ProofAnswer> receive() {
    const auto head = host_->read(5, limits_);
    if (!head) return std::nullopt;
    std::uint32_t length;
    std::memcpy(&length, head->data() + 1, 4);
    if (length > most_output) return std::nullopt;
    const auto words = host_->read(length, limits_);
    if (!words) return std::nullopt;
    ProofAnswer answer = answer_of(static_cast<unsigned char>((*head)[0]));
    answer.words = first_line(*words);
    return answer;
  }

  const ScratchFolder folder_{ScratchFolder::Place::memory};
  fs::path program_;
  ProgramLimits limits_;
  std::optional<Child> host_;
};

class ProgramChecker : public ProofChecker {
 public:
  ProgramChecker(fs::path program, const ProgramLimits& limits) : program_(std::move(program)), limits_(limits) {}

  ProofAnswer check(const ProofFiles& files) override {
    std::vector<std::string> words = {program_.string()};
    for (const std::string& field : own_claim(files.proof)) words.insert(words.end(), {"--require", field});
    const fs::path& folder = folder_.path();
    for (const std::string& name : write_proof_files(files, folder)) words.push_back(folder / name);
    const ProgramEnd end = run_program(std::move(words), limits_);
    return end.kind == ProgramEnd::Kind::exited ? answer_of(end.code) : ProofAnswer{-1, end.words(), ""};
  }

 private:
  const ScratchFolder folder_{ScratchFolder::Place::memory};
  fs::path program_;
  ProgramLimits limits_;
};

}  // namespace

std::vector<std::string> own_claim(const std::string& proof) {
  constexpr std::size_t begin = 28, fixed = 52, longest = 200;  // of CLAM's payload, and of a name that the host reads
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, proof.data() + begin + at, sizeof value);
    return value;
  };
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(proof[begin + at]); };
  if (proof.size() < begin + fixed + 4 || proof.compare(16, 4, "CLAM") != 0 || byte(0) > 2) return {};
  double eta = 0;
  std::memcpy(&eta, proof.data() + begin + 8, sizeof eta);
  const std::uint32_t ring = number(4), merged = number(48);
  if (!std::isfinite(eta) || std::signbit(eta) || ring < 1 || (eta == 0 && ring > 1)) return {};
  std::vector<std::string> fields = {"empty",
                                     fmt::format("strict={}", byte(2) & 1),
                                     fmt::format("points={}", byte(2) >> 1 & 1),
                                     fmt::format("distance={:.17g}", eta),
                                     fmt::format("ring={}", ring),
                                     fmt::format("merged={}", merged)};
  std::string cells = "cells=";
  for (std::size_t i = 16; i < 48; ++i) cells += fmt::format("{:02x}", byte(i));
  if (merged > 0) fields.push_back(cells);
  if (byte(0) == 2) return fields;
  fields.emplace_back(byte(0) == 0 ? "motion=linear" : "motion=rest");
  fields.push_back(fmt::format("dimension={}", byte(1) == 2 ? 2 : 3));
  const std::uint64_t list = fixed + std::uint64_t{8} * merged;
  if (proof.size() < begin + list + 4) return fields;
  std::string pairs;
  const std::uint64_t count = std::min<std::uint64_t>(number(list), (proof.size() - begin - list - 4) / 8);
  for (std::uint64_t i = 0; i < count && pairs.size() < longest; ++i)
    pairs += fmt::format("{}{}-{}", i == 0 ? "" : ",", number(list + 4 + 8 * i), number(list + 8 + 8 * i));
  if (pairs.empty() || pairs.size() > longest) return fields;
  fields.push_back("excluded=" + pairs);
  if (merged == 0) fields.push_back(cells);
  return fields;
}

std::unique_ptr<ProofChecker> hosted_checker(const fs::path& host, std::chrono::milliseconds limit) {
  return std::make_unique<HostedChecker>(host, limit);
}

std::unique_ptr<ProofChecker> program_checker(const fs::path& program, const ProgramLimits& limits) {
  return std::make_unique<ProgramChecker>(program, limits);
}

std::vector<std::string> write_proof_files(const ProofFiles& files, const fs::path& folder) {
  std::vector<std::string> names = {proof_name};
  write_file(folder / proof_name, files.proof);
  for (std::size_t i = 0; i < files.files.size(); ++i) {
    names.push_back(trajectory_name(files, i));
    write_file(folder / names.back(), files.files[i]);
  }
  remove_other_frames(files, folder);
  return names;
}

ProofFiles read_proof_files(const fs::path& folder) {
  ProofFiles files;
  files.proof = read_regular_file(folder / proof_name);
  for (const char* const extension : extensions) {
    files.extension = extension;
    while (fs::exists(folder / trajectory_name(files, files.files.size()))) {
      files.files.push_back(read_regular_file(folder / trajectory_name(files, files.files.size())));
      if (files.extension == "blocks") break;
    }
    if (files.files.empty()) continue;
    require_nothing_else(folder, files);
    return files;
  }
  throw InputError(folder.string(), "", "expected trajectory-0.ply, trajectory-0.obj or trajectory.blocks in it");
}

}  // namespace noli::audit
