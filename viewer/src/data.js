// SPDX-License-Identifier: Apache-2.0
//
// What the page carries: report/page/report_page.h says what is in it and how it is packed.

export const page = () => JSON.parse(document.getElementById("page").textContent);

/** The bytes of a packed element: base64 of a zlib stream. */
async function unpacked(id) {
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Vertex numbers of all cells: faces, then edges, then points. */
export async function cells({ faces, edges, points }) {
  const bytes = await unpacked("cells");
  const all = new Uint32Array(bytes.buffer, 0, bytes.length / 4);
  return {
    faces: all.subarray(0, 3 * faces),
    edges: all.subarray(3 * faces, 3 * faces + 2 * edges),
    points: all.subarray(3 * faces + 2 * edges, 3 * faces + 2 * edges + points),
  };
}

/**
 * Positions of each frame, x y z of each vertex one after another, in 65,535ths of the box.
 * Packed: of each frame all x, all y, all z, less those of the frame before; low bytes first, then high bytes.
 */
export async function frames({ vertices, frames }) {
  const bytes = await unpacked("motion");
  const size = 3 * vertices;
  const all = [];
  let before = new Uint16Array(size);
  for (let f = 0; f < frames; ++f) {
    const now = new Uint16Array(size);
    const low = 2 * f * size,
      high = low + size;
    for (let k = 0, i = 0; k < 3; ++k) {
      for (let v = 0; v < vertices; ++v, ++i) {
        const at = 3 * v + k;
        now[at] = before[at] + (bytes[low + i] | (bytes[high + i] << 8));
      }
    }
    all.push(now);
    before = now;
  }
  return all;
}
