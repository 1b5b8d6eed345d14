// SPDX-License-Identifier: Apache-2.0
// Moved to kernel/contact.h.
#pragma once

#include "kernel/contact.h"
