// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/npz.h"

#include <noli/errors.h>

#ifdef NOLI_WITH_ZIP
#include <fmt/format.h>
#include <zip.h>

#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {

struct NpzFile::Archive {
  explicit Archive(zip_t* opened) : zip(opened) {}
  ~Archive() { zip_discard(zip); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  zip_t* zip;
};

class NpzFile::Member : public ByteStream {
 public:
  Member(zip_t* zip, std::uint64_t number, std::string name)
      : name_(std::move(name)), file_(zip_fopen_index(zip, number, 0)) {
    if (file_ == nullptr) throw InputError(name_, "", std::string("cannot be read: ") + zip_strerror(zip));
  }
  ~Member() override { zip_fclose(file_); }

  std::size_t read(char* to, std::size_t size) override {
    end_if_stopped();
    const zip_int64_t got = zip_fread(file_, to, size);
    if (got < 0) throw InputError(name_, "", std::string("is damaged: ") + zip_file_strerror(file_));
    return static_cast<std::size_t>(got);
  }

 private:
  std::string name_;
  zip_file_t* file_;
};

bool can_read_npz() { return true; }

NpzFile::NpzFile(const std::filesystem::path& path) : name_(path.string()) {
  require_regular_file(path);
  int code = 0;
  zip_t* const zip = zip_open(name_.c_str(), ZIP_RDONLY, &code);
  if (zip == nullptr) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string words = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw InputError(name_, "", "cannot be read as an archive of numpy: " + words);
  }
  archive_ = std::make_unique<Archive>(zip);
  const zip_int64_t count = zip_get_num_entries(zip, 0);
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    const char* const member = zip_get_name(zip, i, ZIP_FL_ENC_RAW);
    const std::string key = member != nullptr ? member : "";
    if (!key.ends_with(".npy")) continue;
    keys_.push_back(key.substr(0, key.size() - 4));
    members_.push_back(i);
  }
}

NpzFile::~NpzFile() = default;

std::uint64_t NpzFile::size(std::size_t key) const {
  zip_stat_t stat;
  if (zip_stat_index(archive_->zip, members_[key], 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0) {
    throw InputError(name_, in_quotes(keys_[key]), "has no length");
  }
  return stat.size;
}

std::unique_ptr<ByteStream> NpzFile::open(std::size_t key) const {
  zip_stat_t stat;
  const std::string name = fmt::format("{}: {}", name_, on_one_line(keys_[key]));
  if (zip_stat_index(archive_->zip, members_[key], 0, &stat) != 0) throw InputError(name, "", "is not described");
  constexpr std::uint64_t large = std::uint64_t{1} << 30, most_fold = 200;
  if (stat.size > large && stat.comp_size < stat.size / most_fold) {
    throw InputError(name, "",
                     fmt::format("has {} bytes that were deflated to {}; expected less: store it (np.savez)", stat.size,
                                 stat.comp_size));
  }
  return std::make_unique<Member>(archive_->zip, members_[key], name);
}

}  // namespace noli

#else

namespace noli {

struct NpzFile::Archive {};

bool can_read_npz() { return false; }
NpzFile::NpzFile(const std::filesystem::path& path) {
  throw InputError(path.string(), "", "this noli was built without libzip; expected one with NOLI_WITH_ZIP");
}
NpzFile::~NpzFile() = default;
std::uint64_t NpzFile::size(std::size_t /*key*/) const { return 0; }
std::unique_ptr<ByteStream> NpzFile::open(std::size_t /*key*/) const { return nullptr; }

}  // namespace noli
#endif
