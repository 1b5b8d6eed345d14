// SPDX-License-Identifier: Apache-2.0
//
// What the cells of a mesh say: which cells have a feature, which vertices hang together, which edges there are.

/** Lists, for each vertex, the cells that have it. `size`: vertices of a cell. */
function cellsByVertex(cells, size, vertices) {
  const begin = new Uint32Array(vertices + 1);
  for (const v of cells) ++begin[v + 1];
  for (let v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  const next = begin.slice();
  const list = new Uint32Array(cells.length);
  for (let i = 0; i < cells.length; ++i) list[next[cells[i]]++] = Math.floor(i / size);
  return (v) => list.subarray(begin[v], begin[v + 1]);
}

export class Topology {
  constructor(cells, vertices) {
    this.cells = cells;
    this.vertices = vertices;
  }

  /** Numbers of the faces that have all vertices of a feature. */
  facesOf(feature) {
    const { faces } = this.cells;
    this.byVertex ??= cellsByVertex(faces, 3, this.vertices);
    const has = (face, v) => faces[3 * face] === v || faces[3 * face + 1] === v || faces[3 * face + 2] === v;
    return [...this.byVertex(feature[0])].filter((face) => feature.every((v) => has(face, v)));
  }

  /** Corners of the faces that have any of these features, three a face, each face once. */
  cornersOf(features) {
    const numbers = new Set(features.flatMap((feature) => this.facesOf(feature)));
    return [...numbers].flatMap((face) => [...this.cells.faces.subarray(3 * face, 3 * face + 3)]);
  }

  /** Corners of the faces that have a vertex nearer to a point than `radius`. `positions`: of all vertices. */
  facesNear(positions, { x, y, z }, radius) {
    const { faces } = this.cells;
    const square = radius * radius;
    const near = (v) =>
      (positions[3 * v] - x) ** 2 + (positions[3 * v + 1] - y) ** 2 + (positions[3 * v + 2] - z) ** 2 < square;
    const corners = [];
    for (let i = 0; i < faces.length; i += 3) {
      if (near(faces[i]) || near(faces[i + 1]) || near(faces[i + 2]))
        corners.push(faces[i], faces[i + 1], faces[i + 2]);
    }
    return corners;
  }

  /** Each edge of the faces once, and the loose edges; two vertices an edge. */
  edges() {
    const seen = new Set();
    const edges = [];
    const add = (a, b) => {
      const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
      if (seen.has(key)) return;
      seen.add(key);
      edges.push(a, b);
    };
    const { faces, edges: loose } = this.cells;
    for (let i = 0; i < faces.length; i += 3) {
      for (let k = 0; k < 3; ++k) add(faces[i + k], faces[i + ((k + 1) % 3)]);
    }
    for (let i = 0; i < loose.length; i += 2) add(loose[i], loose[i + 1]);
    return edges;
  }

  /** For each vertex the number of its connected component, counted by their first vertices. */
  components() {
    const parent = Uint32Array.from({ length: this.vertices }, (_, v) => v);
    const root = (v) => {
      while (parent[v] !== v) v = parent[v] = parent[parent[v]];
      return v;
    };
    const join = (a, b) => {
      const p = root(a),
        q = root(b);
      if (p < q) parent[q] = p;
      else parent[p] = q;
    };
    const { faces, edges } = this.cells;
    for (let i = 0; i < faces.length; i += 3) {
      join(faces[i], faces[i + 1]);
      join(faces[i], faces[i + 2]);
    }
    for (let i = 0; i < edges.length; i += 2) join(edges[i], edges[i + 1]);
    const numbers = new Uint32Array(this.vertices);
    let count = 0;
    // The root of a component is its least vertex, so it has its number before all others need it.
    for (let v = 0; v < this.vertices; ++v) numbers[v] = root(v) === v ? count++ : numbers[root(v)];
    return numbers;
  }
}
