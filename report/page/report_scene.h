// SPDX-License-Identifier: Apache-2.0
//
// The member `scene` of a report's page (report_page.h), and the packed cells and motion that belong to it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/page/report_motion.h"
#include "report/page/report_page.h"

namespace noli::report {

struct ReportPart {
  std::string name;
  std::uint64_t first = 0, vertices = 0;
  bool fixed = false;  ///< all its vertices are pinned or scripted
  bool given = false;  ///< not the motion itself, but the one that it was made from
};

struct ReportScene {
  int dimension = 3;
  const Mesh& mesh;
  std::vector<ReportPart> parts;
  std::string unit;          ///< of times
  double begin = 0;          ///< of the first step
  std::vector<double> ends;  ///< of all steps
  std::string note;          ///< what the frames are
};

void put_scene(const ReportScene& scene, PackedFrames frames, ReportPage& report);

}  // namespace noli::report
