// SPDX-License-Identifier: Apache-2.0
//
// Which faces are drawn, and in which order: those near the eye first, so that what they hide costs nothing where a
// browser computes every pixel.

const buckets = 2048;

/** How far each vertex is in a direction. */
export function depths(positions, { x, y, z }) {
  const list = new Float64Array(positions.length / 3);
  for (let v = 0; v < list.length; ++v)
    list[v] = positions[3 * v] * x + positions[3 * v + 1] * y + positions[3 * v + 2] * z;
  return list;
}

/** The cells of `size` vertices of which no vertex is farther than `most`. */
export function notBefore(cells, size, depth, most) {
  if (most === Infinity) return cells;
  const kept = [];
  for (let i = 0; i < cells.length; i += size) {
    let greatest = -Infinity;
    for (let k = 0; k < size; ++k) greatest = Math.max(greatest, depth[cells[i + k]]);
    if (greatest <= most) for (let k = 0; k < size; ++k) kept.push(cells[i + k]);
  }
  return Uint32Array.from(kept);
}

/** Faces by the depth of their first vertices, from far in the direction, where the eye is, to near; in buckets. */
export function frontToBack(faces, depth) {
  let least = Infinity,
    greatest = -Infinity;
  for (const d of depth) {
    least = Math.min(least, d);
    greatest = Math.max(greatest, d);
  }
  const scale = (buckets - 1) / (greatest - least || 1);
  const bucket = (i) => Math.floor((greatest - depth[faces[i]]) * scale);
  const next = new Uint32Array(buckets + 1);
  for (let i = 0; i < faces.length; i += 3) next[bucket(i) + 1] += 3;
  for (let b = 0; b < buckets; ++b) next[b + 1] += next[b];
  const out = new Uint32Array(faces.length);
  for (let i = 0; i < faces.length; i += 3) {
    const at = next[bucket(i)];
    next[bucket(i)] += 3;
    out.set(faces.subarray(i, i + 3), at);
  }
  return out;
}
