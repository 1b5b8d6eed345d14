// SPDX-License-Identifier: Apache-2.0
//
// A time of impact: a real algebraic number in [0, 1].
#pragma once
