// SPDX-License-Identifier: Apache-2.0
//
// The options of commands that are given frames: in which order, and what becomes of polygons.
#pragma once

#include <CLI/CLI.hpp>

#include "trajectory/frame_order.h"
#include "trajectory/polygons.h"

namespace noli::app {

/// --order natural | given; neither: the order given has to be that of the numbers in the names.
void add_order_option(CLI::App& command, FrameOrder& order);

/// --polygons fan | refuse
void add_polygons_option(CLI::App& command, PolygonRule& polygons);

}  // namespace noli::app
