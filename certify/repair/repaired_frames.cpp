// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/repaired_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <utility>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/json.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

constexpr const char* table_head = "file,time,given,what,sha256\n";

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

/// The last two cells of a row.
std::array<std::string, 2> ends_of(const std::string& row) {
  const std::size_t last = row.rfind(','), before = row.rfind(',', last - 1);
  return {row.substr(before + 1, last - before - 1), row.substr(last + 1)};
}

bool is_whole(double time) { return time == std::floor(time); }

}  // namespace

std::vector<std::filesystem::path> files_beside_repaired(const std::string& pattern) {
  const FramePattern parsed = parse_pattern(pattern);
  return {parsed.beside("times.csv"), parsed.beside("repair.json")};
}

bool is_of_repaired(const std::filesystem::path& file, const std::string& pattern) {
  std::error_code error;
  const auto place = [&error](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(path.is_absolute() ? path : std::filesystem::current_path() / path, error);
  };
  const FramePattern parsed = parse_pattern(pattern);
  const auto number = parsed.number(parsed.folder() / file.filename());
  if (number && place(parsed.file(*number)) == place(file)) return true;
  return std::ranges::any_of(files_beside_repaired(pattern),
                             [&](const auto& path) { return place(path) == place(file); });
}

RepairedFrames::RepairedFrames(const RepairRequest& request, const FrameSource& source)
    : request_(request),
      source_(source),
      write_(frame_writer_of(request.pattern)),
      table_(files_beside_repaired(request.pattern)[0]),
      state_(files_beside_repaired(request.pattern)[1]),
      fingerprint_(find_fingerprint()),
      state_text_(Json({{"noli_repair", 1}, {"of", hex(fingerprint_)}}).dump() + '\n'),
      resumes_(request.resume && is_there()),
      files_(request.pattern,
             request.force || resumes_ ? FrameFiles::Existing::replaced : FrameFiles::Existing::refused) {
  for (const auto& frame : request.frames) {
    if (!files_.may_be(frame)) continue;
    throw UsageError("-o " + request.pattern + ": " + frame.string() + " is read; choose another folder or name");
  }
  for (const auto& beside : {table_, state_, files_.series_path()}) {
    if (is_read(beside)) {
      throw UsageError("-o " + request.pattern + ": " + beside.string() + " is read; choose another folder or name");
    }
    const auto status = std::filesystem::symlink_status(beside);
    if (status.type() == std::filesystem::file_type::not_found || request.force || resumes_) continue;
    throw UsageError("-o " + request.pattern + ": " + beside.string() +
                     " exists already; choose another name, or pass --force");
  }
}

bool RepairedFrames::is_read(const std::filesystem::path& file) const {
  std::vector<std::filesystem::path> read = request_.frames;
  if (request_.ignore) read.push_back(*request_.ignore);
  read.emplace_back(request_.masses);
  std::error_code error;
  return std::ranges::any_of(read, [&](const auto& path) { return std::filesystem::equivalent(path, file, error); });
}

Sha256Digest RepairedFrames::find_fingerprint() const {
  std::string text = fmt::format("{}\n{} {} {} {} {} {} {}\n", version_commit(), request_.pattern, request_.fixed_first,
                                 request_.restitution, request_.friction, request_.points,
                                 request_.thickness.value_or(0), request_.dimension.value_or(0));
  text += fmt::format("{} {} {} {}\n", request_.masses, request_.spread, request_.only_new,
                      request_.reading.polygons == PolygonRule::refuse);
  if (request_.masses != "size" && request_.masses != "uniform") text += read_whole_file(request_.masses);
  for (const std::string& key : request_.reading.keys) text += key + '\n';
  for (const VertexId v : request_.fixed_listed) text += fmt::format("{} ", v);
  for (const std::string& body : request_.fixed_bodies) text += body + '\n';
  for (const BodyFrames& body : request_.reading.bodies) text += fmt::format("{} {}\n", body.name, body.still);
  if (request_.ignore) text += read_whole_file(*request_.ignore);
  for (const FrameFacts& facts : source_.facts()) {
    const std::string name = std::filesystem::path(facts.file).filename().string();  // wherever it is now
    text += fmt::format("{} {} {} {}\n", name, facts.body, facts.bytes, hex(facts.sha256));
  }
  Sha256 hash;
  hash.update(text);
  return hash.digest();
}

bool RepairedFrames::is_there() const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(state_, error) || !std::filesystem::is_regular_file(table_, error))
    return false;
  if (read_whole_file(state_) == state_text_) return true;
  throw InputError(state_.string(), "",
                   "is of a repair of other frames, with other options or by another version; expected the same");
}

std::optional<RepairedFrames::Last> RepairedFrames::begin(const Mesh& mesh) {
  std::string table = table_head;
  std::vector<double> times;
  if (resumes_) keep_complete_steps(table, times);
  // In this order, the state never stands beside rows of another repair.
  replace_file(table_, table);
  replace_file(state_, state_text_);
  if (times.empty()) return std::nullopt;
  const std::filesystem::path file = files_.file(times.size() - 1);
  Frame frame = read_frame(file);
  require_same_mesh(mesh, source_.name(0), frame.mesh, file);
  const auto step = static_cast<std::size_t>(times.back());
  files_.go_on(std::move(times));
  return Last{step, std::move(frame.positions)};
}

/// The rows up to the last frame at the end of a step that is there; a line without its end was torn.
void RepairedFrames::keep_complete_steps(std::string& table, std::vector<double>& times) {
  std::ifstream in(table_, std::ios::binary);
  std::string line;
  std::size_t complete = 0, complete_bytes = table.size();
  std::getline(in, line);
  while (std::getline(in, line) && !in.eof()) {
    const std::filesystem::path file = files_.file(times.size());
    const std::string name = csv_cell(file.filename().string()) + ',';
    double time = 0;
    if (!line.starts_with(name) || !std::filesystem::is_regular_file(file)) break;
    const auto [rest, error] = std::from_chars(line.data() + name.size(), line.data() + line.size(), time);
    const bool later = times.empty() ? time == 0 : time > times.back();
    if (error != std::errc() || *rest != ',' || !later) break;
    const auto [what, hash] = ends_of(line);
    const FrameFacts facts = file_facts(file, [] { return stop_asked().has_value(); });
    if (hex(facts.sha256) != hash) {
      throw InputError(file.string(), "", "has changed since it was written; expected no --resume, but --force");
    }
    times.push_back(time);
    table += line + '\n';
    written_.push_back({time, what, facts});
    if (!is_whole(time)) continue;
    complete = times.size();
    complete_bytes = table.size();
  }
  times.resize(complete);
  written_.resize(complete);
  table.resize(complete_bytes);
}

std::size_t RepairedFrames::count(std::string_view what) const {
  return static_cast<std::size_t>(std::ranges::count(written_, what, &RepairedFrame::what));
}

void RepairedFrames::write(double time, const Frame& frame, bool given) {
  const auto k = static_cast<std::size_t>(time);
  const char* what = given ? "given" : is_whole(time) ? "repaired" : "inserted";
  const std::filesystem::path file = files_.file(files_.count());
  const std::string name = csv_cell(file.filename().string());
  if (given && has_own_file(k)) {
    files_.add_copy(time, request_.frames[k]);
    what = "copied";
  } else {
    files_.add(time, frame, write_);
  }
  const FrameFacts facts = file_facts(file);
  pending_ += fmt::format("{},{},{},{},{}\n", name, time, is_whole(time) ? csv_cell(source_.name(k)) : "", what,
                          hex(facts.sha256));
  written_.push_back({time, what, facts});
}

void RepairedFrames::commit() {
  std::ofstream table(table_, std::ios::app | std::ios::binary);
  table << pending_;
  table.close();
  if (table.fail()) throw WriteError(table_.string() + ": cannot be written");
  pending_.clear();
}

bool RepairedFrames::has_own_file(std::size_t k) const {
  return request_.reading.bodies.empty() && source_.count() == request_.frames.size() &&
         is_frame_name(request_.frames[k]) && request_.frames[k].extension() == files_.ending();
}

void RepairedFrames::finish(RepairOutcome& outcome) {
  if (files_.count() > 0) files_.finish();  // else it would only remove what an earlier repair wrote
  outcome.frames = files_.count();
  outcome.copied = count("copied");
  outcome.as_given = outcome.copied + count("given");
  outcome.inserted = count("inserted");
  outcome.removed = files_.removed();
  outcome.times = table_;
  outcome.written = std::move(written_);
}

}  // namespace noli
