// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/repaired_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include <noli/errors.h>
#include "certify/json.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

constexpr const char* table_head = "file,time,given,what\n";

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

bool is_whole(double time) { return time == std::floor(time); }

FrameFiles::Existing existing(const RepairRequest& request) {
  return request.force || request.resume ? FrameFiles::Existing::replaced : FrameFiles::Existing::refused;
}

}  // namespace

RepairedFrames::RepairedFrames(const RepairRequest& request, const FrameSource& source)
    : request_(request),
      source_(source),
      files_(request.pattern, existing(request)),
      write_(frame_writer_of(request.pattern)),
      table_(files_.folder() / "times.csv"),
      state_(files_.folder() / "repair.json") {
  for (const auto& frame : request.frames) {
    if (!files_.may_be(frame)) continue;
    throw UsageError("-o " + request.pattern + ": " + frame.string() + " is read; choose another folder or name");
  }
}

/// Thread counts, limits, the proof and the checker do not decide what is written.
std::string RepairedFrames::fingerprint() const {
  std::string text =
      fmt::format("{} {} {} {} {} {} {}\n", request_.pattern, request_.fixed_first, request_.restitution,
                  request_.friction, request_.points, request_.thickness.value_or(0), request_.dimension.value_or(0));
  for (const std::string& body : request_.fixed_bodies) text += body + '\n';
  text += request_.masses + '\n';
  if (request_.ignore) text += read_whole_file(*request_.ignore);
  for (const FrameFacts& facts : source_.facts()) text += fmt::format("{} {}\n", facts.file, facts.bytes);
  Sha256 hash;
  hash.update(text);
  return hex(hash.digest());
}

std::optional<RepairedFrames::Last> RepairedFrames::go_on() {
  const Json mine = {{"noli_repair", 1}, {"of", fingerprint()}};
  std::error_code error;
  if (request_.resume && std::filesystem::exists(state_, error) && std::filesystem::exists(table_, error)) {
    if (Json::parse(read_whole_file(state_), nullptr, false) != mine) {
      throw InputError(state_.string(), "", "is of a repair of other frames, or with other options; expected the same");
    }
    rows_ = rows_of_table();
    while (!rows_.empty() && !(is_whole(rows_.back().time) && std::filesystem::exists(files_.file(rows_.size() - 1)))) {
      rows_.pop_back();
    }
  }
  std::string table = table_head;
  std::vector<double> times;
  for (const Row& row : rows_) {
    table += row.text;
    times.push_back(row.time);
  }
  replace_file(state_, mine.dump() + '\n');
  replace_file(table_, table);
  committed_ = rows_.size();
  if (rows_.empty()) return std::nullopt;
  files_.go_on(std::move(times));
  return Last{static_cast<std::size_t>(rows_.back().time), read_frame(files_.file(rows_.size() - 1)).positions};
}

/// Up to the first one that this program did not write like this.
std::vector<RepairedFrames::Row> RepairedFrames::rows_of_table() const {
  std::vector<Row> rows;
  std::ifstream in(table_, std::ios::binary);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line) && !in.eof()) {  // a line without its end was torn
    const std::string name = csv_cell(files_.file(rows.size()).filename().string()) + ',';
    const std::size_t what = line.rfind(',');
    Row row{0, line + '\n', what == std::string::npos ? "" : line.substr(what + 1)};
    if (!line.starts_with(name)) break;
    const auto [rest, error] = std::from_chars(line.data() + name.size(), line.data() + line.size(), row.time);
    const bool later = rows.empty() ? row.time == 0 : row.time > rows.back().time;
    if (error != std::errc() || *rest != ',' || !later) break;
    rows.push_back(std::move(row));
  }
  return rows;
}

void RepairedFrames::write(double time, const Frame& frame, bool given) {
  const auto k = static_cast<std::size_t>(time);
  const char* what = given ? "given" : is_whole(time) ? "repaired" : "inserted";
  const std::string name = csv_cell(files_.file(files_.count()).filename().string());
  if (given && has_own_file(k)) {
    files_.add_copy(time, request_.frames[k]);
    what = "copied";
  } else {
    files_.add(time, frame, write_);
  }
  rows_.push_back(
      {time, fmt::format("{},{},{},{}\n", name, time, is_whole(time) ? csv_cell(source_.name(k)) : "", what), what});
}

void RepairedFrames::commit() {
  std::ofstream table(table_, std::ios::app | std::ios::binary);
  for (; committed_ < rows_.size(); ++committed_) table << rows_[committed_].text;
  table.close();
  if (table.fail()) throw WriteError(table_.string() + ": cannot be written");
}

bool RepairedFrames::has_own_file(std::size_t k) const {
  return request_.reading.bodies.empty() && source_.count() == request_.frames.size() &&
         is_frame_name(request_.frames[k]) && request_.frames[k].extension() == files_.ending();
}

void RepairedFrames::finish(RepairOutcome& outcome) {
  files_.finish();
  outcome.frames = files_.count();
  outcome.copied = static_cast<std::size_t>(std::ranges::count(rows_, "copied", &Row::what));
  outcome.inserted = static_cast<std::size_t>(std::ranges::count(rows_, "inserted", &Row::what));
  outcome.removed = files_.removed();
  outcome.times = table_;
}

std::vector<std::filesystem::path> RepairedFrames::files() const {
  std::vector<std::filesystem::path> all;
  for (std::uint64_t i = 0; i < files_.count(); ++i) all.push_back(files_.file(i));
  return all;
}

}  // namespace noli
