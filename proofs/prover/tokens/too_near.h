// SPDX-License-Identifier: Apache-2.0
// Moved to proofs/prover/findings.h.
#pragma once

#include "proofs/prover/findings.h"
