// SPDX-License-Identifier: Apache-2.0
#include "mutants.h"

const noli::mutants::Mutant noli::mutants::chosen = noli::mutants::Mutant::MUTANT;
