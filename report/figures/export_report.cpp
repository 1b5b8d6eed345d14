// SPDX-License-Identifier: Apache-2.0
#include "report/figures/export_report.h"

#include <fmt/format.h>

#include <noli/errors.h>

namespace noli::report {
namespace {

constexpr const char* open_window_is_left_out = "The run ends in a window that was never committed; it is left out.\n";

}  // namespace

Answer export_answer(const ExportRequest& request, const ExportOutcome& outcome) {
  Answer answer(outcome.interrupted ? "interrupted" : "written");
  if (!outcome.pvd.empty()) answer.text += fmt::format("ParaView opens the series: {}\n", on_one_line(outcome.pvd));
  if (outcome.removed > 0) answer.text += fmt::format("Removed: {} files of an earlier export.\n", outcome.removed);
  if (outcome.recorded) {
    answer.text += "The run recorded frames: these were written, at the scene's frame_rate, not at --fps.\n";
  }
  if (outcome.open_window) answer.text += open_window_is_left_out;
  answer.text += "Straight lines between these frames are not the certified motion; the world lines of the run are.\n";
  answer.place = fmt::format("{}  {} frames of {} windows, up to {} s", on_one_line(request.pattern), outcome.frames,
                             outcome.windows, outcome.end);
  return answer;
}

Answer figure_answer(const FigureRequest& request, const FigureOutcome& outcome) {
  Answer answer("written");
  if (outcome.open_window) answer.text = open_window_is_left_out;
  answer.place = fmt::format("{}  {} of {} windows, up to {} s", on_one_line(request.output), request.figure,
                             outcome.windows, outcome.end);
  return answer;
}

Answer picture_answer(const PictureRequest& request, const PictureOutcome& outcome) {
  Answer answer("written");
  answer.place = fmt::format("{}  {} x {} pixels, at {} s", on_one_line(request.output.string()), outcome.width,
                             outcome.height, outcome.time);
  return answer;
}

Answer repair_picture_answer(const RepairPictureRequest& request, const PictureOutcome& outcome) {
  Answer answer("written");
  answer.place = fmt::format("{}  {} at {} steps, {} x {} pixels", on_one_line(request.output.string()),
                             request.given ? "as given" : "repaired", outcome.time, outcome.width, outcome.height);
  return answer;
}

Answer contact_export_answer(const ContactExportRequest& request, const ContactExport& shown) {
  Answer answer("written");
  answer.text = shown.picture
                    ? "Red: cells of the first feature. Yellow: cells of the second.\n"
                    : "The cell array \"contact\": 1 for cells of the first feature, 2 for cells of the second.\n";
  answer.place = fmt::format("{}  step {} at t = {}, {} cells marked", on_one_line(request.output.string()), shown.step,
                             shown.time, shown.cells);
  return answer;
}

}  // namespace noli::report
