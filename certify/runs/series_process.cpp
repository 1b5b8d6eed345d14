// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/series_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include "certify/process/this_program.h"
#include "trajectory/text.h"

namespace noli {
namespace {

std::string how_it_ended(const ProgramEnd& end) {
  if (end.kind == ProgramEnd::Kind::exited) return fmt::format("noli_series ended with code {}", end.code);
  return "noli_series was ended by " + end.words();
}

}  // namespace

bool SeriesProgram::available() const { return ::access(file.c_str(), X_OK) == 0; }

SeriesProgram series_program() { return {.file = beside_this_program("noli_series")}; }

SeriesProcess::SeriesProcess(const SeriesProgram& program, int output)
    : limits_{.time = program.patience, .stop = program.stop, .to_end = {}},
      child_({program.file.string(), "write"}, {.in = Child::piped, .out = output, .err = Child::piped}) {}

void SeriesProcess::took_nothing() const {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(limits_.time);
  throw SeriesLost(fmt::format("noli_series read nothing for {} s", seconds.count()));
}

void SeriesProcess::write(std::string_view bytes) {
  switch (child_.write(bytes, limits_)) {
    case Child::Written::all: return;
    case Child::Written::stopped: throw SeriesStopped();
    case Child::Written::late: took_nothing();
    case Child::Written::refused: finish(); throw SeriesLost("noli_series ended before all was written");
  }
}

void SeriesProcess::finish() {
  const ProgramEnd end = child_.finish(limits_);
  if (end.kind == ProgramEnd::Kind::stopped) throw SeriesStopped();
  if (end.kind == ProgramEnd::Kind::hung) took_nothing();
  if (end.exited_with(0)) return;
  throw SeriesLost(end.kind == ProgramEnd::Kind::signalled || end.err.empty() ? how_it_ended(end)
                                                                              : first_line(end.err));
}

}  // namespace noli
