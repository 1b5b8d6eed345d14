// SPDX-License-Identifier: Apache-2.0
//
// How bodies of a scene meet.
#pragma once

#include <vector>

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/field.h"

namespace noli::integrator {

/// Reads the object `contact`, which the schema has accepted. Throws InputError: bodies that are not there, pairs that
/// are said twice or are excluded, both of two fields that exclude each other, steps longer than the window or above
/// the limit of stability (unless allow_unstable), exponents that let something through.
SceneContact read_contact(const Field& f, const Scene& scene);

}  // namespace noli::integrator
