// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <noli/run.h>

namespace noli::certificates {
using noli::CertificateCounts;
}  // namespace noli::certificates
