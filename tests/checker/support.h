// SPDX-License-Identifier: Apache-2.0
//
// Defines expectations on verdicts.
#pragma once

#include <gtest/gtest.h>

#include "proof_writer.h"

/// Expects a verdict with this code whose words contain `contains`.
#define EXPECT_VERDICT(expression, expected, contains)                         \
  do {                                                                         \
    const Verdict found_ = (expression);                                       \
    EXPECT_EQ(found_.code, expected) << found_.words;                          \
    EXPECT_NE(found_.words.find(contains), std::string::npos) << found_.words; \
  } while (false)
#define EXPECT_ACCEPTED(expression) EXPECT_VERDICT(expression, 0, "")
#define EXPECT_REJECTED(expression, why) EXPECT_VERDICT(expression, 3, why)
