// SPDX-License-Identifier: Apache-2.0
#include "app/frame_options.h"

#include <string>

namespace noli::app {

void add_order_option(CLI::App& command, FrameOrder& order) {
  command
      .add_option_function<std::string>(
          "--order",
          [&order](const std::string& word) { order = word == "natural" ? FrameOrder::natural : FrameOrder::given; },
          "natural: sort frames by the numbers in their names; given: take them as they are. Without it, names given "
          "against their numbers are an error")
      ->check(CLI::IsMember({"natural", "given"}))
      ->type_name("natural|given");
}

void add_polygons_option(CLI::App& command, PolygonRule& polygons) {
  command
      .add_option_function<std::string>(
          "--polygons",
          [&polygons](const std::string& word) { polygons = word == "fan" ? PolygonRule::fan : PolygonRule::refuse; },
          "fan (the default): cut faces of more than three corners into triangles that begin at the first corner; "
          "refuse: they are an error")
      ->check(CLI::IsMember({"fan", "refuse"}))
      ->type_name("fan|refuse");
}

}  // namespace noli::app
