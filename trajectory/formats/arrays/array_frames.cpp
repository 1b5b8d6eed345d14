// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/array_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/formats/arrays/array_values.h"
#include "trajectory/formats/frames.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_columns = std::size_t{1} << 25;  ///< numbers that are kept of an array in Fortran's order

/// What is wrong with the length of an array; "" if nothing is.
std::string fault_of(const NpyHeader& header, std::uint64_t bytes) {
  if (!header.refusal.empty() || header.bytes() == bytes) return "";
  return fmt::format("is {}, which takes {} bytes, but has {}", header.text(), header.bytes(), bytes);
}

}  // namespace

bool is_array_name(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".npz" || extension == ".npy";
}

ArrayFrames::ArrayFrames(const std::vector<fs::path>& files, const std::vector<std::string>& keys)
    : StoredFrames(files) {
  if (extension_of(files[0]) == ".npz") {
    if (files.size() > 1) throw InputError(files[1].string(), "", "expected only one .npz file");
    add_npz(files[0]);
  } else {
    for (std::size_t i = 0; i < files.size(); ++i) add_npy(files[i], i);
  }
  const std::string where = files.size() == 1 ? files[0].string() : "the arrays";
  chosen_ = choose_arrays(arrays_, keys, where);
  if (archive_ && keys.empty()) {
    if (!archive_->others().empty()) {
      throw InputError(where, "",
                       fmt::format("has the member {}, which is not an .npy; --keys POSITIONS,FACES leaves it out",
                                   in_quotes(archive_->others()[0])));
    }
    require_others_whole();
  }
  read_mesh();
  describe();
}

void ArrayFrames::add_npz(const fs::path& file) {
  archive_ = std::make_unique<NpzFile>(file);
  for (std::size_t i = 0; i < archive_->members().size(); ++i) {
    end_if_stopped();
    const std::string& key = archive_->members()[i].key;
    StoredArray array{key, fmt::format("{}: {}", file.string(), on_one_line(key)), 0, {}, "", {}};
    const auto open = [this, i, name = array.name] {
      auto bytes = archive_->open(i);
      read_npy_header(*bytes, name);
      return bytes;
    };
    try {
      const auto bytes = archive_->open(i);
      const auto header = read_npy_header(*bytes, array.name);
      array.fault = header ? fault_of(*header, archive_->members()[i].size) : "is empty";
      if (header) array.header = *header;
    } catch (const InputError& error) {
      array.fault = message_without_name(error.what(), array.name);
    }
    array.open = open;
    arrays_.push_back(std::move(array));
  }
}

void ArrayFrames::add_npy(const fs::path& file, std::size_t number) {
  if (extension_of(file) != ".npy") {
    throw InputError(file.string(), "", "is not an .npy file; expected all arrays in such files, or one .npz");
  }
  require_regular_file(file);
  StoredArray array{file.stem().string(), file.string(), number, {}, "", {}};
  FileBytes bytes(file);
  const auto header = read_npy_header(bytes, array.name);
  if (!header) throw InputError(array.name, "", "is empty");
  array.header = *header;
  const std::string fault = fault_of(*header, fs::file_size(file));
  if (!fault.empty()) throw InputError(array.name, "", fault);
  array.open = [file] {
    auto opened = std::make_unique<FileBytes>(file);
    read_npy_header(*opened, file.string());
    return opened;
  };
  arrays_.push_back(std::move(array));
}

/// That no other array fits was told by their headers: a damaged one might have been the faces.
void ArrayFrames::require_others_whole() const {
  std::array<char, 1 << 16> part{};
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    const StoredArray* const array = &arrays_[i];
    if (std::ranges::count(chosen_.positions, array) + std::ranges::count(chosen_.cells, array) > 0) continue;
    const auto bytes = archive_->open(i);
    while (bytes->read(part.data(), part.size()) > 0) {
    }
  }
}

void ArrayFrames::read_mesh() {
  mesh_.vertex_count = chosen_.vertices;
  for (const StoredArray* const cells : chosen_.cells) {
    const auto bytes = cells->open();
    const std::vector<std::int64_t> vertices = integers_of(*bytes, cells->header, cells->name);
    require_end(*bytes, cells->name);
    append_cells(mesh_, vertices, corners_of(cells->header), cells->name);
  }
  drop_redundant_cells(mesh_);
}

void ArrayFrames::describe() {
  for (std::size_t i = 0; i < facts().size(); ++i) facts_of(i).frames = 0;
  for (const StoredArray* const array : chosen_.positions) {
    FrameFacts& facts = facts_of(array->file);
    facts.numbers = array->header.type();
    facts.vertices = chosen_.vertices;
    facts.cells = mesh_.cell_count();
    facts.frames += chosen_.positions.size() == 1 ? chosen_.frames : 1;
  }
  if (!archive_) return;
  std::vector<std::string>& names = facts_of(0).arrays;
  names = {chosen_.positions[0]->key};
  for (const StoredArray* const cells : chosen_.cells) names.push_back(cells->key);
}

std::vector<std::string> ArrayFrames::notes() const {
  if (!archive_) return {};
  std::vector<std::string> names;
  for (const StoredArray* const cells : chosen_.cells) names.push_back(on_one_line(cells->key));
  return {fmt::format("positions are the array {}, cells {}", on_one_line(chosen_.positions[0]->key),
                      names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")))};
}

std::optional<Frame> ArrayFrames::read(std::size_t k) {
  if (k >= chosen_.frames) return std::nullopt;
  end_if_stopped();
  const std::vector<double> numbers = numbers_of_frame(k);
  require_unchanged(chosen_.positions[chosen_.positions.size() > 1 ? k : 0]->file);
  if (k + 1 == chosen_.frames) require_same_bytes();
  return Frame{mesh_, positions_of(numbers, chosen_.coordinates, name(k))};
}

std::vector<double> ArrayFrames::numbers_of_frame(std::size_t k) {
  const bool one_a_file = chosen_.positions.size() > 1;
  const StoredArray& array = *chosen_.positions[one_a_file ? k : 0];
  if (one_a_file) {
    stream_ = nullptr;
    columns_count_ = 0;
    next_ = 0;
    k = 0;
  }
  if (!array.header.fortran) return next_in_order(array, k);
  if (k < columns_first_ || k >= columns_first_ + columns_count_) load_columns(array, k);
  const std::size_t size = chosen_.vertices, stride = columns_count_;
  std::vector<double> numbers(size * chosen_.coordinates);
  for (std::size_t c = 0; c < chosen_.coordinates; ++c) {
    for (std::size_t v = 0; v < size; ++v) {
      numbers[v * chosen_.coordinates + c] = columns_[(c * size + v) * stride + (k - columns_first_)];
    }
  }
  return numbers;
}

std::vector<double> ArrayFrames::next_in_order(const StoredArray& array, std::size_t k) {
  if (!stream_ || k < next_) {
    stream_ = array.open();
    next_ = 0;
  }
  const std::size_t size = chosen_.vertices * chosen_.coordinates;
  if (k > next_) skip_numbers(*stream_, array.header, array.name, std::uint64_t{size} * (k - next_));
  std::vector<double> numbers;
  while (numbers.size() < size) {  // grows as bytes come
    end_if_stopped();
    const std::size_t before = numbers.size();
    numbers.resize(std::min(size, std::max<std::size_t>(2 * before, 4096)));
    read_numbers(*stream_, array.header, array.name, std::span<double>(numbers).subspan(before));
  }
  next_ = k + 1;
  if (next_ == chosen_.frames) require_end(*stream_, array.name);
  return numbers;
}

void ArrayFrames::load_columns(const StoredArray& array, std::size_t first) {
  const std::size_t rows = chosen_.vertices * chosen_.coordinates;
  const std::size_t frames = chosen_.positions.size() > 1 ? 1 : chosen_.frames;
  columns_first_ = first;
  columns_count_ = std::min(frames - first, std::max<std::size_t>(most_columns / rows, 1));
  columns_.resize(rows * columns_count_);
  const auto bytes = array.open();
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % 1024 == 0) end_if_stopped();
    skip_numbers(*bytes, array.header, array.name, first);
    read_numbers(*bytes, array.header, array.name,
                 std::span<double>(columns_).subspan(row * columns_count_, columns_count_));
    skip_numbers(*bytes, array.header, array.name, frames - first - columns_count_);
  }
  require_end(*bytes, array.name);
}

}  // namespace noli
