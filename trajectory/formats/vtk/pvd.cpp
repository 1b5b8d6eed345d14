// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/pvd.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "trajectory/formats/vtk/vtk_xml.h"
#include "trajectory/text.h"

namespace noli {

std::vector<std::filesystem::path> files_of_pvd(const std::filesystem::path& series) {
  const std::string bytes = read_whole_file(series);
  constexpr std::string_view collection[] = {"Collection"};
  const VtkXml xml(bytes, series.string(), collection);
  std::vector<std::filesystem::path> files;
  double before = 0;
  for (const pugi::xml_node entry : xml.content().children("DataSet")) {
    const std::string file = entry.attribute("file").value();
    const std::string part = entry.attribute("part").value();
    if (!part.empty() && part != "0")
      throw InputError(series.string(), file,
                       "is part " + in_quotes(part) + " of a frame; expected frames of one part");
    if (file.empty()) throw InputError(series.string(), "DataSet", "names no file");
    double time = 0;
    const std::string problem = parse_finite(std::string_view(entry.attribute("timestep").value()), time);
    if (!problem.empty()) throw InputError(series.string(), file, "timestep: " + problem);
    if (!files.empty() && !(time > before)) {
      throw InputError(series.string(), file,
                       fmt::format("is at time {}, and the file before at {}; expected ascending times, one file each",
                                   time, before));
    }
    before = time;
    files.push_back(series.parent_path() / file);
  }
  if (files.empty()) throw InputError(series.string(), "", "names no frame");
  return files;
}

}  // namespace noli
