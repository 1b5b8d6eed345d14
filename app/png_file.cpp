// SPDX-License-Identifier: Apache-2.0
#include "noli/app/png_file.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#ifdef NOLI_WITH_PNG
#include <png.h>
#endif

namespace noli::app {

#ifdef NOLI_WITH_PNG

bool can_write_png() { return true; }

void write_png(const std::filesystem::path& path, const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  errno = 0;
  if (png_image_write_to_file(&image, path.c_str(), 0, picture.bytes.data(), 0, nullptr) != 0) return;
  const int error = errno != 0 ? errno : EIO;
  throw std::system_error(error, std::generic_category(), path.string());
}

#else

bool can_write_png() { return false; }

void write_png(const std::filesystem::path&, const Picture&) {
  throw std::logic_error("write_png: built without a library for PNG");
}

#endif

}  // namespace noli::app
