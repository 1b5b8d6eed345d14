// SPDX-License-Identifier: Apache-2.0
#include "report/figures/run_figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include <noli/errors.h>
#include "certify/runs/run_folder.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "trajectory/stop.h"
#include "trajectory/write_file.h"

namespace noli::report {
namespace {

std::size_t number_of(const std::string& name) {
  const auto found = std::find(figure_names.begin(), figure_names.end(), name);
  if (found == figure_names.end()) {
    throw UsageError(fmt::format("--figure {}: expected one of {}", name, fmt::join(figure_names, ", ")));
  }
  return static_cast<std::size_t>(found - figure_names.begin());
}

/// Whether a picture is wanted, not numbers.
bool is_picture(const std::string& output) {
  const std::string ending = std::filesystem::path(output).extension().string();
  if (ending == ".svg") return true;
  if (ending == ".csv") return false;
  throw UsageError("-o " + output + ": expected a name that ends in .svg or .csv");
}

FigureData read(const std::filesystem::path& run, SeriesReader& reader) {
  FigureData data{title_of(run), reader.header().dimension, {}};
  while (const auto window = reader.next_window()) {
    end_if_stopped();
    data.windows.push_back({window->begin, reader.row()});
  }
  if (data.windows.empty()) {
    throw InputError(run.string(), "", "the run has no windows; expected at least one to draw");
  }
  return data;
}

}  // namespace

FigureOutcome run_figure(const FigureRequest& request) {
  const std::size_t figure = number_of(request.figure);
  const bool picture = is_picture(request.output);
  SeriesReader reader = open_run(request.run);
  const FigureData data = read(request.run, reader);
  replace_file(request.output, (picture ? svg_writers() : csv_writers())[figure](data));
  return {data.windows.size(), data.windows.back().row.time, reader.open_window().has_value()};
}

}  // namespace noli::report
