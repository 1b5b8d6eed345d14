// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "certificates/run_values.h"

namespace noli::certificates {
using noli::CertificateCounts;
}  // namespace noli::certificates
