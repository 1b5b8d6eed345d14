// SPDX-License-Identifier: Apache-2.0
//
// CRC-32C (Castagnoli), as RFC 3720 appendix B.4 defines it. It detects damage by a disk or a transfer, not deliberate
// changes (sha256.h does).
#pragma once

#include <cstdint>
#include <string_view>

namespace noli {

/// The CRC of `bytes`. For a text in parts, pass the CRC of the parts before: crc32c(b, crc32c(a)) = crc32c(ab).
std::uint32_t crc32c(std::string_view bytes, std::uint32_t crc = 0);

/// The two implementations, for tests: plain C++, and the processor's instruction (three times as fast). Precondition
/// of the latter: has_crc_instruction().
std::uint32_t crc32c_plain(std::string_view bytes, std::uint32_t crc = 0);
bool has_crc_instruction();
std::uint32_t crc32c_by_instruction(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace noli
