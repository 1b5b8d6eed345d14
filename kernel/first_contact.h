// SPDX-License-Identifier: Apache-2.0
// Moved to kernel/time_of_impact.h.
#pragma once

#include "kernel/time_of_impact.h"
