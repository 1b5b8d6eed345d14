// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/repaired_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/json.h"
#include "certify/result_file.h"
#include "certify/runs/run_folder.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

constexpr std::string_view table_head = "file,time,given,what,sha256\n";

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

std::vector<std::filesystem::path> files_read(const RepairRequest& request) {
  std::vector<std::filesystem::path> read = request.frames;
  if (request.ignore) read.push_back(*request.ignore);
  if (request.masses != "size" && request.masses != "uniform") read.emplace_back(request.masses);
  if (request.fixed_file) read.push_back(*request.fixed_file);
  return read;
}

std::vector<std::filesystem::path> files_beside_repaired(const std::string& pattern) {
  const FramePattern parsed = parse_pattern(pattern);
  return {parsed.beside("times.csv"), parsed.beside("repair.json"), parsed.beside("changed.jsonl")};
}

bool is_of_repaired(const std::filesystem::path& file, const std::string& pattern) {
  const FramePattern parsed = parse_pattern(pattern);
  const auto number = parsed.number(parsed.folder() / file.filename());
  if (number && place_of(parsed.file(*number)) == place_of(file)) return true;
  return std::ranges::any_of(files_beside_repaired(pattern),
                             [&](const auto& path) { return place_of(path) == place_of(file); });
}

RepairedFrames::RepairedFrames(const RepairRequest& request, const FrameSource& source)
    : request_(request),
      source_(source),
      write_(frame_writer_of(request.pattern)),
      table_(files_beside_repaired(request.pattern)[0]),
      state_(files_beside_repaired(request.pattern)[1]),
      changed_(files_beside_repaired(request.pattern)[2]),
      fingerprint_(find_fingerprint()),
      state_text_(Json({{"noli_repair", 1}, {"of", hex(fingerprint_)}}).dump() + '\n'),
      resumes_(request.resume && is_there()),
      replaces_(request.force || resumes_ || (request.resume && has_only_begun())),
      files_(request.pattern, replaces_ ? FrameFiles::Existing::replaced : FrameFiles::Existing::refused) {
  lock_folder(files_.folder().empty() ? "." : files_.folder(), "-o", lock_);  // against other repairs
  for (const auto& file : files_read(request)) {
    if (!files_.may_be(file)) continue;
    throw UsageError("-o " + request.pattern + ": " + file.string() + " is read; choose another folder or name");
  }
  for (const auto& beside : {table_, state_, changed_, files_.series_path()}) {
    if (is_read(beside)) {
      throw UsageError("-o " + request.pattern + ": " + beside.string() + " is read; choose another folder or name");
    }
    const auto status = std::filesystem::symlink_status(beside);
    if (status.type() == std::filesystem::file_type::not_found || replaces_) continue;
    throw UsageError("-o " + request.pattern + ": " + beside.string() +
                     " exists already; choose another name, or pass --force");
  }
}

bool RepairedFrames::is_read(const std::filesystem::path& file) const {
  std::error_code error;
  return std::ranges::any_of(files_read(request_),
                             [&](const auto& path) { return std::filesystem::equivalent(path, file, error); });
}

Sha256Digest RepairedFrames::find_fingerprint() const {
  const auto hash_of = [](std::string_view text) {
    Sha256 hash;
    hash.update(text);
    return hash.digest();
  };
  Json json = {{"noli", version_commit()},
               {"pattern", request_.pattern},
               {"dimension", request_.dimension.value_or(0)},
               {"points", request_.points},
               {"only_new", request_.only_new},
               {"refuse_polygons", request_.reading.polygons == PolygonRule::refuse},
               {"keys", request_.reading.keys},
               {"fixed_first", request_.fixed_first},
               {"fixed_listed", request_.fixed_listed},
               {"fixed_bodies", request_.fixed_bodies},
               {"thickness", request_.thickness.value_or(0)},
               {"masses", request_.masses},
               {"restitution", request_.restitution},
               {"friction", request_.friction},
               {"spread", request_.spread}};
  if (request_.masses != "size" && request_.masses != "uniform")
    json["masses_file"] = hex(hash_of(read_whole_file(request_.masses)));
  if (request_.ignore) json["ignore"] = hex(hash_of(read_whole_file(*request_.ignore)));
  // Arrays from the start: where null is to become one and memory runs out, this JSON library leaves neither.
  Json bodies = Json::array(), inputs = Json::array();
  for (const BodyFrames& body : request_.reading.bodies) bodies.push_back({body.name, body.still});
  for (const FrameFacts& facts : source_.facts()) {
    // Wherever the file is now.
    inputs.push_back(
        {std::filesystem::path(facts.file).filename().string(), facts.body, facts.bytes, hex(facts.sha256)});
  }
  json["bodies"] = std::move(bodies);
  json["inputs"] = std::move(inputs);
  return hash_of(to_text(json));
}

bool RepairedFrames::is_there() const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(state_, error) || !std::filesystem::is_regular_file(table_, error))
    return false;
  if (read_whole_file(state_) == state_text_) return true;
  if (has_only_begun()) return false;
  throw InputError(state_.string(), "",
                   "belongs to a repair with different frames, options or version; expected the same");
}

/// Whether a repair ended while it wrote its first files. The table is the first of them; with --force, the others may
/// still be those of another repair.
bool RepairedFrames::has_only_begun() const {
  std::error_code error;
  return std::filesystem::file_size(table_, error) == table_head.size() && !error &&
         read_whole_file(table_) == table_head;
}

std::optional<RepairedFrames::Last> RepairedFrames::last(const Mesh& mesh) {
  if (!resumes_) return std::nullopt;
  std::vector<double> times;
  read_rows(times);
  if (times.empty()) return std::nullopt;
  const std::filesystem::path file = files_.file(times.size() - 1);
  Frame frame = read_frame(file);
  require_same_mesh(mesh, source_.name(0), frame.mesh, file);
  const auto step = static_cast<std::size_t>(times.back());
  files_.go_on(std::move(times));
  return Last{step, std::move(frame.positions), read_changed(step)};
}

void RepairedFrames::begin() {
  // In this order, the state never stands beside rows of another repair.
  replace_file(table_, std::string(table_head) + rows_);
  replace_file(changed_, changes_);
  replace_file(state_, state_text_);
}

/// The time of a row of the table about frame k; nothing if it is no such row.
std::optional<double> RepairedFrames::time_of_row(const std::string& row, std::size_t k) const {
  const std::string name = csv_cell(files_.file(k).filename().string()) + ',';
  double time = 0;
  if (!row.starts_with(name)) return std::nullopt;
  const auto [rest, error] = std::from_chars(row.data() + name.size(), row.data() + row.size(), time);
  if (error != std::errc() || rest == row.data() + row.size() || *rest != ',') return std::nullopt;
  return time;
}

/// Reads the rows up to the last frame at the end of a step that is there. Only the last line may be torn. A frame that
/// was edited must not be written again, so each that is there has to have its hash.
void RepairedFrames::read_rows(std::vector<double>& times) {
  std::ifstream in(table_, std::ios::binary);
  std::string line;
  const auto require = [&](bool right, std::size_t number) {
    if (right) return;
    throw InputError(
        table_.string(), fmt::format("line {}", number),
        "is damaged; expected the table as it was written, or --force without --resume, which starts over");
  };
  std::getline(in, line);
  require(!in.eof() && line + '\n' == table_head, 1);
  std::vector<RepairedFrame> written;
  std::string rows;
  std::size_t complete = 0, complete_bytes = 0;
  bool all_there = true;
  for (std::size_t k = 0; std::getline(in, line) && !in.eof(); ++k) {
    const std::optional<double> time = time_of_row(line, k);
    const bool later = time && (k == 0 ? *time == 0 : times.empty() || *time > times.back());
    require(later, k + 2);
    const std::filesystem::path file = files_.file(k);
    all_there = all_there && std::filesystem::is_regular_file(file);
    if (!std::filesystem::exists(file)) continue;
    const auto [what, hash] = ends_of(line);
    const FrameFacts facts = file_facts(file, [] { return stop_asked().has_value(); });
    if (hex(facts.sha256) != hash) {
      throw InputError(file.string(), "",
                       "has changed since it was written; --force without --resume starts over and replaces it");
    }
    if (!all_there) continue;
    times.push_back(*time);
    rows += line + '\n';
    written.push_back({*time, what, facts});
    if (!is_whole(*time)) continue;
    complete = times.size();
    complete_bytes = rows.size();
  }
  times.resize(complete);
  written.resize(complete);
  rows.resize(complete_bytes);
  written_ = std::move(written);
  rows_ = std::move(rows);
}

/// The lines of the first steps, one for each that has new frames at least. Later ones are of a step that was not
/// committed.
std::vector<std::string> RepairedFrames::read_changed(std::size_t steps) {
  std::set<std::uint64_t> missing;
  for (const RepairedFrame& frame : written_) {
    if (frame.what == "inserted" || frame.what == "repaired")
      missing.insert(static_cast<std::uint64_t>(std::ceil(frame.time)));
  }
  std::vector<std::string> lines;
  std::ifstream in(changed_, std::ios::binary);
  std::string line;
  for (std::uint64_t before = 0; std::getline(in, line) && !in.eof();) {
    const Json json = Json::parse(line, nullptr, false);
    const Json step = json.is_object() ? json.value("step", Json()) : Json();
    if (!step.is_number_unsigned() || step.get<std::uint64_t>() <= before) fail_changed(lines.size());
    before = step.get<std::uint64_t>();
    if (before > steps) break;
    missing.erase(before);
    changes_ += line + '\n';
    lines.push_back(line);
  }
  if (!missing.empty()) fail_changed(lines.size());
  return lines;
}

void RepairedFrames::fail_changed(std::size_t line) const {
  throw InputError(changed_.string(), fmt::format("line {}", line + 1),
                   "is damaged or missing; --force without --resume starts over");
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
  append(changed_, pending_changed_);
  append(table_, pending_);
}

void RepairedFrames::append(const std::filesystem::path& file, std::string& lines) {
  if (lines.empty()) return;
  std::ofstream out(file, std::ios::app | std::ios::binary);
  out << lines;
  out.close();
  if (out.fail()) throw WriteError(file.string() + ": cannot be written");
  lines.clear();
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
