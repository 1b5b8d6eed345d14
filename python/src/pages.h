// SPDX-License-Identifier: Apache-2.0
//
// Pages for a browser and pictures, as `noli report` and `noli export` write them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <noli/errors.h>
#include "python/src/options.h"
#include "report/figures/run_picture.h"
#include "report/page/report_page.h"
#include "report/page/report_verdict.h"
#include "trajectory/write_file.h"

namespace noli::python {

/// Writes the page that `fill` fills. Throws UsageError if this build has no pages, WriteError, and what `fill` throws.
inline void write_page(const std::filesystem::path& file, const std::string& title,
                       const std::function<void(report::ReportPage&)>& fill) {
  if (!report::has_report_page()) {
    throw UsageError("this noli was built without reports; build it with NOLI_WITH_REPORT=ON");
  }
  report::ReportPage page;
  page.page = report::empty_page();
  fill(page);
  page.page["title"] = title;
  replace_file(file, report::report_html(page));
}

/// "view", "size", "zoom": how a picture shows a motion.
inline report::PictureView picture_view(const pybind11::dict& options) {
  report::PictureView view;
  put(options, "view", view.from);
  put(options, "size", view.size);
  put(options, "zoom", view.zoom);
  return view;
}

}  // namespace noli::python
