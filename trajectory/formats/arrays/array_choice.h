// SPDX-License-Identifier: Apache-2.0
//
// Which of the arrays in files of numpy are the motion.
//
//   positions   real numbers, (T, n, 3) or (T, n, 2): T frames of n vertices; or, as .npy files of one frame each,
//               (n, 3) or (n, 2). Two coordinates are x and y
//   cells       integers: (m, 3) faces, (m, 2) loose edges, (m,) loose points, indices from 0
//
// Where only one array can be the positions, and one the faces, none needs a name.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trajectory/formats/arrays/npy.h"

namespace noli {

struct StoredArray {
  std::string key, name;  ///< "vertices"; "motion.npz: vertices", as errors call it
  std::size_t file = 0;   ///< which of the files it is in
  NpyHeader header;
  std::string fault;  ///< why it cannot be read although its type can be; empty: it can
  /// Its bytes from the first number on.
  std::function<std::unique_ptr<ByteStream>()> open;
};

struct ChosenArrays {
  std::vector<const StoredArray*> positions;  ///< one with all frames, or one per frame
  std::vector<const StoredArray*> cells;

  /// How many frames, vertices, and coordinates of a vertex.
  std::size_t frames = 0, vertices = 0, coordinates = 3;
};

/// Whether an array has positions of one frame, real numbers (n, 3) or (n, 2); whether it has cells.
bool is_one_frame(const NpyHeader& header);
bool is_cells(const NpyHeader& header);

/// `keys`: the positions, then cells; empty: those that can be no other. `where`: what errors call all of them.
/// Throws InputError: nothing fits, or several do; it lists what there is.
ChosenArrays choose_arrays(const std::vector<StoredArray>& arrays, const std::vector<std::string>& keys,
                           const std::string& where);

}  // namespace noli
