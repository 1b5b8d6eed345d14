// SPDX-License-Identifier: Apache-2.0
#include "app/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "app/terminal.h"
#include "certify/result_file.h"
#include "report/documents.h"
#include "report/page/report_verdict.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

std::string verdict_in_colour(const report::Answer& answer) {
  switch (report::tone_of(answer.verdict())) {
    case report::Tone::good: return inked(answer.verdict_word(), Ink::green, STDOUT_FILENO);
    case report::Tone::bad: return inked(answer.verdict_word(), Ink::red, STDOUT_FILENO);
    case report::Tone::open: return inked(answer.verdict_word(), Ink::yellow, STDOUT_FILENO);
    case report::Tone::neutral: break;
  }
  return answer.verdict_word();
}

std::string words_of(const report::Answer& answer, bool verbose) {
  return answer.text_above(verbose) + answer.last_line(verdict_in_colour(answer)) + '\n';
}

}  // namespace

Output::Output(OutputOptions options, const std::vector<std::filesystem::path>& inputs, std::vector<OutputFile> others)
    : options_(std::move(options)) {
  if (options_.json) others.insert(others.begin(), {"--json", *options_.json});
  require_output_files(others, inputs, options_.force);
}

std::string Output::words(const report::Answer& answer) const {
  if (options_.quiet) return "";
  if (options_.porcelain) return answer.porcelain();
  return words_of(answer, options_.verbose);
}

void Output::write(std::string_view schema, const report::Answer& answer, Json json) const {
  const std::optional<std::string>& path = options_.json;
  if (!path) return write_standard_output(words(answer));
  const Json document = report::document(schema, std::move(json));
  if (*path == "-") return write_standard_output(to_text(document));
  write_result(*path, to_text(document));
  write_standard_output(words(answer));
}

void write_words(const report::Answer& answer) { write_standard_output(words_of(answer, false)); }

void write_standard_output(const std::string& text) {
  if (!write_all(STDOUT_FILENO, text))
    throw WriteError(std::string("standard output: cannot be written: ") + std::strerror(errno));
}

}  // namespace noli::app
