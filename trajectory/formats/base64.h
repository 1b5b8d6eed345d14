// SPDX-License-Identifier: Apache-2.0
//
// Encodes bytes as text in base64 (RFC 4648, section 4).
#pragma once

#include <string>
#include <string_view>

namespace noli {

std::string base64(std::string_view bytes);

}  // namespace noli
