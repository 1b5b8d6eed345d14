// SPDX-License-Identifier: Apache-2.0
#include "report/figures/png.h"

#include <stdexcept>

#ifdef NOLI_WITH_PNG
#include <png.h>
#endif

namespace noli::report {

#ifdef NOLI_WITH_PNG

bool can_write_png() { return true; }

std::string png(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("png: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

#else

bool can_write_png() { return false; }

std::string png(const Picture&) { throw std::logic_error("png: built without a library for it"); }

#endif

}  // namespace noli::report
