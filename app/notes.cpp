// SPDX-License-Identifier: Apache-2.0
#include "app/notes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "app/terminal.h"
#include "trajectory/blocks/folder_lock.h"

namespace noli::app {
namespace {

constexpr std::size_t most_notes = 10;

}  // namespace

void tell_note(const std::string& note) {
  std::fputs(fmt::format("noli: {} {}.\n", inked("note:", Ink::cyan, STDERR_FILENO), on_one_line(note)).c_str(),
             stderr);
}

void tell_notes(const std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < std::min(notes.size(), most_notes); ++i) tell_note(notes[i]);
  if (notes.size() <= most_notes) return;
  tell_note(fmt::format("`noli explain` lists {} more", notes.size() - most_notes));
}

void note_missing_short_form() { tell_note("--short changes nothing: the scene has no \"short\""); }

void note_if_being_written(const std::filesystem::path& run) {
  if (is_locked(run)) tell_note(run.string() + " is being written: this is about what is committed so far");
}

}  // namespace noli::app
