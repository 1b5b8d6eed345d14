// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "report/figures/picture.h"

namespace noli::report {

/// Whether this program was built with a library for it.
bool can_write_png();

/// The bytes of a file. Throws std::logic_error without a library, std::runtime_error when the library fails.
std::string png(const Picture& picture);

}  // namespace noli::report
