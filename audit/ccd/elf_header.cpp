// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/elf_header.h"

#include <elf.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <optional>

#include <noli/errors.h>

namespace noli::audit {
namespace {

/// The fields that are in the same place for 32 and 64 bits.
struct Head {
  unsigned char ident[EI_NIDENT];
  Elf64_Half type, machine;
};

std::optional<Head> head_of(const std::filesystem::path& file) {
  Head head = {};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (in.gcount() != sizeof head || std::memcmp(head.ident, ELFMAG, SELFMAG) != 0) return std::nullopt;
  return head;
}

std::string described(const Head& head) {
  const char* const bits = head.ident[EI_CLASS] == ELFCLASS64 ? "64" : "32";
  const char* const order = head.ident[EI_DATA] == ELFDATA2LSB ? "little" : "big";
  return fmt::format("machine {}, {} bits, {} endian", head.machine, bits, order);
}

/// The number of the machine, when its bytes are in the other order than ours.
void swap_if_foreign(Head& head, const Head& own) {
  if (head.ident[EI_DATA] == own.ident[EI_DATA]) return;
  const auto swapped = [](Elf64_Half x) { return static_cast<Elf64_Half>((x >> 8) | (x << 8)); };
  head.type = swapped(head.type);
  head.machine = swapped(head.machine);
}

}  // namespace

void require_shared_library(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& problem) { throw InputError(file.string(), "", problem); };
  std::error_code error;
  if (!std::filesystem::exists(file, error)) refuse("does not exist; expected a shared library");
  if (!std::filesystem::is_regular_file(file, error)) refuse("is not a file; expected a shared library");
  if (!std::ifstream(file, std::ios::binary)) refuse("cannot be read");
  std::optional<Head> head = head_of(file);
  const std::optional<Head> own = head_of("/proc/self/exe");
  if (!head) refuse("is not a shared library (it does not begin like an ELF file)");
  if (!own) return;
  swap_if_foreign(*head, *own);
  if (described(*head) != described(*own)) {
    refuse(fmt::format("is for another machine (ELF: {}; expected {})", described(*head), described(*own)));
  }
  if (head->type != ET_DYN)
    refuse(fmt::format("is an ELF file, but not a shared library (type {}; expected 3)", head->type));
}

}  // namespace noli::audit
