// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/zip_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include <noli/errors.h>
#include "trajectory/input_file.h"

namespace noli {
namespace {

constexpr std::uint64_t end_bytes = 22, end_locator_bytes = 20, end64_bytes = 56, entry_bytes = 46;
constexpr std::uint64_t comment_bytes = 0xffff;  ///< the longest comment
/// libzip keeps about five times as much.
constexpr std::uint64_t most_directory_bytes = std::uint64_t{1} << 24;

/// The integer of `bytes` bytes that begins there.
std::uint64_t zip_number(const std::string& text, std::size_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes; i > 0; --i) value = value << 8 | static_cast<unsigned char>(text[at + i - 1]);
  return value;
}

}  // namespace

ZipArchive::ZipArchive(const std::filesystem::path& path) : file_(open_regular_file(path)) {
  const std::string name = path.string();
  file_.seekg(0, std::ios::end);
  size_ = static_cast<std::uint64_t>(file_.tellg());
  file_at_ = size_;
  const std::uint64_t entries = check_directory(name);
  zip_error_init(&error_);
  zip_source_t* const source = zip_source_function_create(answer, this, &error_);
  if (source != nullptr) zip_ = zip_open_from_source(source, ZIP_RDONLY, &error_);
  if (zip_ == nullptr) zip_source_free(source);
  if (zip_error_code_zip(&error_) == ZIP_ER_MEMORY) throw std::bad_alloc();
  if (zip_ == nullptr || static_cast<std::uint64_t>(zip_get_num_entries(zip_, 0)) != entries) {
    zip_discard(zip_);
    throw InputError(name, "", "has a damaged directory");
  }
}

ZipArchive::~ZipArchive() { zip_discard(zip_); }

/// The number of entries. The directory goes up to its end record, which is the end of the file: so no entry is missed,
/// and no other directory is hidden in a comment.
std::uint64_t ZipArchive::check_directory(const std::string& name) {
  const std::string record = size_ < end_bytes ? "" : bytes_at(size_ - end_bytes, end_bytes);
  if (!record.starts_with("PK\5\6")) {
    throw InputError(name, "",
                     "cannot be read as an archive of numpy: it does not end with the end of a directory; expected a "
                     "whole archive without a comment");
  }
  const auto damaged = [&](bool so) {
    if (so) throw InputError(name, "", "has a damaged directory");
  };
  std::uint64_t entries = zip_number(record, 10, 2), bytes = zip_number(record, 12, 4);
  std::uint64_t begin = zip_number(record, 16, 4), end = size_ - end_bytes;
  const std::string locator = end < end_locator_bytes ? "" : bytes_at(end - end_locator_bytes, end_locator_bytes);
  if (locator.starts_with("PK\6\7")) {
    damaged(end < end_locator_bytes + end64_bytes);
    end -= end_locator_bytes + end64_bytes;
    const std::string record64 = bytes_at(end, end64_bytes);
    damaged(!record64.starts_with("PK\6\6") || zip_number(locator, 8, 8) != end);
    entries = zip_number(record64, 32, 8);
    bytes = zip_number(record64, 40, 8);
    begin = zip_number(record64, 48, 8);
  }
  damaged(zip_number(record, 20, 2) != 0 || begin > end || bytes != end - begin || entries > bytes / entry_bytes);
  if (bytes > most_directory_bytes) {
    throw InputError(name, "",
                     fmt::format("has a directory of {} bytes; expected at most {}: save fewer arrays", bytes,
                                 most_directory_bytes));
  }
  return entries;
}

/// Reads without seeking where it goes on: that would read the stream's buffer again.
bool ZipArchive::read_file(std::uint64_t at, char* to, std::uint64_t length) {
  if (at != file_at_) file_.seekg(static_cast<std::streamoff>(at));
  file_.read(to, static_cast<std::streamsize>(length));
  file_at_ = at + length;
  return file_.good();
}

/// Those bytes; "" if they cannot be read.
std::string ZipArchive::bytes_at(std::uint64_t at, std::uint64_t length) {
  std::string bytes(length, 0);
  return read_file(at, bytes.data(), length) ? bytes : "";
}

/// The next bytes of the file with its comment of zeros, whose length the last two bytes of the file tell.
zip_int64_t ZipArchive::read_with_comment(char* to, std::uint64_t length) {
  const std::uint64_t at = source_at_, end = std::min(size_ + comment_bytes, at + length), begin_of_length = size_ - 2;
  if (at < begin_of_length && !read_file(at, to, std::min(end, begin_of_length) - at)) {
    zip_error_set(&error_, ZIP_ER_READ, 0);
    return -1;
  }
  for (std::uint64_t i = std::max(at, begin_of_length); i < end; ++i) to[i - at] = i < size_ ? '\xff' : '\0';
  source_at_ = end;
  return static_cast<zip_int64_t>(end - at);
}

/// What libzip asks of the file. Throws nothing.
zip_int64_t ZipArchive::answer(void* archive, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  auto& self = *static_cast<ZipArchive*>(archive);
  zip_int64_t at = 0;
  switch (command) {
    case ZIP_SOURCE_OPEN: self.source_at_ = 0; return 0;
    case ZIP_SOURCE_READ: return self.read_with_comment(static_cast<char*>(data), length);
    case ZIP_SOURCE_SEEK:
      at = zip_source_seek_compute_offset(self.source_at_, self.size_ + comment_bytes, data, length, &self.error_);
      if (at >= 0) self.source_at_ = static_cast<std::uint64_t>(at);
      return at < 0 ? -1 : 0;
    case ZIP_SOURCE_TELL: return static_cast<zip_int64_t>(self.source_at_);
    case ZIP_SOURCE_STAT: {
      auto& stat = *static_cast<zip_stat_t*>(data);
      zip_stat_init(&stat);
      stat.size = self.size_ + comment_bytes;
      stat.valid = ZIP_STAT_SIZE;
      return sizeof stat;
    }
    case ZIP_SOURCE_ERROR: return zip_error_to_data(&self.error_, data, length);
    case ZIP_SOURCE_SUPPORTS: return ZIP_SOURCE_SUPPORTS_SEEKABLE;
    default:  // closing and freeing: the file is this object's
      return 0;
  }
}

}  // namespace noli
