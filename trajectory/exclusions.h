// SPDX-License-Identifier: Apache-2.0
// Moved to trajectory/mesh.h.
#pragma once

#include "trajectory/mesh.h"
