// SPDX-License-Identifier: Apache-2.0
//
// Describes what `noli export` has written.
#pragma once

#include <noli/export.h>
#include "report/answer.h"
#include "report/figures/contact_export.h"
#include "report/figures/repair_picture.h"
#include "report/figures/run_figure.h"
#include "report/figures/run_picture.h"

namespace noli::report {

/// Of frames or a film.
Answer export_answer(const ExportRequest& request, const ExportOutcome& outcome);

Answer figure_answer(const FigureRequest& request, const FigureOutcome& outcome);

/// Of a run at one time.
Answer picture_answer(const PictureRequest& request, const PictureOutcome& outcome);

/// Of a motion of a repair at one time.
Answer repair_picture_answer(const RepairPictureRequest& request, const PictureOutcome& outcome);

Answer contact_export_answer(const ContactExportRequest& request, const ContactExport& shown);

}  // namespace noli::report
