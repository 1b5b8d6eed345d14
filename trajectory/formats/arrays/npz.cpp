// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/npz.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <noli/errors.h>
#include "trajectory/formats/arrays/zip_archive.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// The bytes of a member, from its beginning. With its last byte, its length and its sum are compared with those that
/// the archive states.
class Member : public ByteStream {
 public:
  Member(std::shared_ptr<ZipArchive> archive, const NpzMember& member, std::string name)
      : archive_(std::move(archive)), name_(std::move(name)), left_(member.size) {
    zip_stat_t stat;
    if (zip_stat_index(archive_->get(), member.number, 0, &stat) != 0) fail();
    if (stat.encryption_method != ZIP_EM_NONE) {
      throw InputError(name_, "", "is encrypted; expected a member without a password");
    }
    if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE) {
      throw InputError(
          name_, "",
          fmt::format("is compressed by method {}; expected a member that is stored or deflated", stat.comp_method));
    }
    file_ = zip_fopen_index(archive_->get(), member.number, 0);
    if (file_ == nullptr) fail();
  }
  ~Member() override { zip_fclose(file_); }

  std::size_t read(char* to, std::size_t size) override {
    end_if_stopped();
    const std::uint64_t wanted = std::min<std::uint64_t>(size, left_);
    const zip_int64_t got = wanted > 0 ? zip_fread(file_, to, wanted) : 0;
    if (got < 0 || (got == 0 && wanted > 0)) fail();
    left_ -= static_cast<std::uint64_t>(got);
    if (left_ == 0 && !compared_) compare();
    return static_cast<std::size_t>(got);
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(name_, "", "is damaged: it cannot be inflated, or its length or checksum is wrong");
  }
  /// libzip compares the sum where it finds the end.
  void compare() {
    char more = 0;
    if (zip_fread(file_, &more, 1) != 0) fail();
    compared_ = true;
  }

  std::shared_ptr<ZipArchive> archive_;
  std::string name_;
  std::uint64_t left_;  ///< bytes that are still to come
  bool compared_ = false;
  zip_file_t* file_ = nullptr;
};

}  // namespace

NpzFile::NpzFile(const std::filesystem::path& path)
    : name_(path.string()), archive_(std::make_shared<ZipArchive>(path)) {
  const auto entries = static_cast<zip_uint64_t>(zip_get_num_entries(archive_->get(), 0));
  for (zip_uint64_t i = 0; i < entries; ++i) {
    end_if_stopped();
    zip_stat_t stat;
    if (zip_stat_index(archive_->get(), i, ZIP_FL_ENC_RAW, &stat) != 0) {
      throw InputError(name_, "", "has a damaged directory");
    }
    const std::string key = stat.name;
    if (key.ends_with(".npy")) {
      members_.push_back({key.substr(0, key.size() - 4), stat.size, stat.comp_size, i});
    } else {
      others_.push_back(key);
    }
  }
}

std::unique_ptr<ByteStream> NpzFile::open(std::size_t number) const {
  const NpzMember& member = members_[number];
  const std::string name = fmt::format("{}: {}", name_, on_one_line(member.key));
  constexpr std::uint64_t large = std::uint64_t{1} << 30, most_fold = 200;
  if (member.size > large && member.packed < member.size / most_fold) {
    throw InputError(
        name, "",
        fmt::format("has {} bytes, deflated to only {}; store it uncompressed (np.savez)", member.size, member.packed));
  }
  return std::make_unique<Member>(archive_, member, name);
}

}  // namespace noli
