// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/npz.h"

#include <fmt/format.h>
#include <minizip/unzip.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include <noli/errors.h>
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// An archive that is open.
class Archive {
 public:
  explicit Archive(const std::string& file) : zip_(unzOpen64(file.c_str())) {
    if (zip_ == nullptr) throw InputError(file, "", "cannot be read as an archive of numpy");
  }
  ~Archive() { unzClose(zip_); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  unzFile get() const { return zip_; }

 private:
  unzFile zip_;
};

/// The bytes of a member, from its beginning. Its sum is compared at its end.
class Member : public ByteStream {
 public:
  Member(const std::string& file, const NpzMember& member, std::string name)
      : archive_(file), name_(std::move(name)), left_(member.size) {
    unz64_file_pos at{member.offset, member.number};
    if (unzGoToFilePos64(archive_.get(), &at) != UNZ_OK || unzOpenCurrentFile(archive_.get()) != UNZ_OK) {
      throw InputError(name_, "", "cannot be read: damaged, encrypted, or neither stored nor deflated");
    }
  }
  ~Member() override { unzCloseCurrentFile(archive_.get()); }

  std::size_t read(char* to, std::size_t size) override {
    end_if_stopped();
    if (ended_) return 0;
    const int got = unzReadCurrentFile(archive_.get(), to, static_cast<unsigned>(size));
    ended_ = got == 0 && size > 0;
    if (got > 0) left_ -= std::min<std::uint64_t>(left_, static_cast<std::uint64_t>(got));
    if (got < 0 || (ended_ && left_ > 0) || (ended_ && unzCloseCurrentFile(archive_.get()) == UNZ_CRCERROR)) {
      throw InputError(name_, "", "is damaged: it cannot be inflated, or its sum is wrong");
    }
    return static_cast<std::size_t>(got);
  }

 private:
  Archive archive_;
  std::string name_;
  std::uint64_t left_;  ///< bytes that are still to come
  bool ended_ = false;
};

}  // namespace

NpzFile::NpzFile(const std::filesystem::path& path) : name_(path.string()) {
  open_regular_file(path);
  const Archive archive(name_);
  constexpr std::size_t longest_name = 1 << 12;
  std::string name(longest_name, 0);
  int code = unzGoToFirstFile(archive.get());
  for (; code == UNZ_OK; code = unzGoToNextFile(archive.get())) {
    unz_file_info64 info;
    unz64_file_pos at;
    if (unzGetCurrentFileInfo64(archive.get(), &info, name.data(), name.size(), nullptr, 0, nullptr, 0) != UNZ_OK ||
        unzGetFilePos64(archive.get(), &at) != UNZ_OK) {
      throw InputError(name_, "", "has a damaged directory");
    }
    directory_bytes_ += 46 + info.size_filename + info.size_file_extra + info.size_file_comment;
    const std::string key = name.substr(0, std::min<std::size_t>(info.size_filename, longest_name));
    end_if_stopped();
    if (!key.ends_with(".npy")) {
      others_.push_back(key);
      continue;
    }
    if (info.uncompressed_size >= 0xffffffff) {
      throw InputError(name_, in_quotes(key), "has 4 GB or more; expected a .npy file for so large an array");
    }
    members_.push_back({key.substr(0, key.size() - 4), info.uncompressed_size, info.compressed_size,
                        at.pos_in_zip_directory, at.num_of_file});
  }
  // What lies behind a damaged entry would be missed.
  if (code != UNZ_END_OF_LIST_OF_FILE) throw InputError(name_, "", "has a damaged directory");
  require_end_of_directory();
}

/// The directory goes up to its end record, which is the end of the file: so no entry is missed, and no other directory
/// is hidden in a comment.
void NpzFile::require_end_of_directory() const {
  std::ifstream file = open_regular_file(name_);
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(file.tellg());
  constexpr std::uint64_t record = 22;
  std::string end(record, 0);
  const bool read = size >= record && file.seekg(static_cast<std::streamoff>(size - record)) &&
                    file.read(end.data(), static_cast<std::streamsize>(record));
  const auto number = [&](std::size_t at, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = bytes; i > 0; --i) value = value << 8 | static_cast<unsigned char>(end[at + i - 1]);
    return value;
  };
  const bool plain = read && end.starts_with("PK\5\6");
  if (!plain) throw InputError(name_, "", "has something behind its directory; expected an archive without a comment");
  const std::uint64_t begin = number(16, 4), length = number(12, 4);
  const bool large = begin == 0xffffffff || length == 0xffffffff || number(10, 2) == 0xffff;
  const std::uint64_t entries = members_.size() + others_.size();
  if (!large && (begin + length != size - record || directory_bytes_ != length || number(10, 2) != entries)) {
    throw InputError(name_, "", "has a damaged directory");
  }
}

std::unique_ptr<ByteStream> NpzFile::open(std::size_t number) const {
  const NpzMember& member = members_[number];
  const std::string name = fmt::format("{}: {}", name_, on_one_line(member.key));
  constexpr std::uint64_t large = std::uint64_t{1} << 30, most_fold = 200;
  if (member.size > large && member.packed < member.size / most_fold) {
    throw InputError(name, "",
                     fmt::format("has {} bytes that were deflated to {}; expected less: store it (np.savez)",
                                 member.size, member.packed));
  }
  return std::make_unique<Member>(name_, member, name);
}

}  // namespace noli
