// SPDX-License-Identifier: Apache-2.0
// Moved to trajectory/error.h.
#pragma once

#include "trajectory/error.h"
