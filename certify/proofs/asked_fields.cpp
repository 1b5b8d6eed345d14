// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/asked_fields.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include <noli/errors.h>
#include <noli/proof.h>
#include "certify/runs/run_folder.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

std::string field_of(const std::string& word) { return word.substr(0, word.find('=')); }

bool asks(const std::vector<std::string>& words, const std::string& field) {
  return std::ranges::any_of(words, [&](const std::string& word) { return field_of(word) == field; });
}

void ask_for_claim(const std::filesystem::path& claim, std::vector<std::string>& words) {
  const std::vector<std::string> by_name = words;
  for (const std::string& word : read_claim_file(claim)) {
    if (!asks(by_name, field_of(word))) words.push_back(word);
  }
}

void ask_for_all_windows(const std::filesystem::path& run, std::vector<std::string>& words,
                         std::vector<std::string>& notes) {
  const LogFacts log = read_log(run);
  if (const auto note = note_of_lost_log(log); note && !is_locked(run)) notes.push_back(*note);
  std::optional<SeriesReader> reader;
  std::uint64_t windows = 0;
  try {
    reader.emplace(open_run(run, log));
    windows = reader->look().windows;
  } catch (const InputError&) {
    return;
  }
  if (windows >= log.known.count) return reader->look_for_expected();
  if (!asks(words, "steps")) words.push_back("steps=" + std::to_string(log.known.count));
}

}  // namespace noli
