// SPDX-License-Identifier: Apache-2.0
//
// From where a contact is seen best: the faces that meet fill a good part of the view, and nothing is before them.
//
// The sphere that the camera fits is a few times as large as those faces. Of some directions the one is taken in which
// the fewest faces hide the contact and the faces that meet look largest. Where all hide it, the view is cut open.
import * as THREE from "three";

const context = 1.9; // radius of the sphere over that of the faces that meet
const leastPart = 2e-3; // of the scene's radius: below it rounded positions are all that is seen
const hiddenPenalty = 0.35; // of one face before the contact, over the size of the faces that meet

const middle = (points) => points.reduce((sum, p) => sum.add(p), new THREE.Vector3()).divideScalar(points.length);

/** The point of a segment a b nearest to a segment c d, by a few alternating projections. */
function nearestOnEdge([a, b], [c, d]) {
  const onto = (p, from, to) => {
    const along = to.clone().sub(from);
    const t = along.lengthSq() > 0 ? p.clone().sub(from).dot(along) / along.lengthSq() : 0;
    return from.clone().addScaledVector(along, Math.min(1, Math.max(0, t)));
  };
  let p = middle([a, b]);
  for (let i = 0; i < 32; ++i) p = onto(onto(p, c, d), a, b);
  return p;
}

/** Where two features meet, as well as rounded positions say. */
export function meetingPoint(features) {
  const [one, other] = features;
  if (one.length === 1) return one[0].clone();
  if (other.length === 1) return other[0].clone();
  return one.length === 2 && other.length === 2 ? nearestOnEdge(one, other) : middle([...one, ...other]);
}

/** Normals of triangles, as long as twice their areas. */
function normals(corners) {
  const list = [];
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = corners.slice(i, i + 3);
    list.push(b.clone().sub(a).cross(c.clone().sub(a)));
  }
  return list;
}

/**
 * How many faces a ray from `origin` hits farther away than `least`, and how far the nearest of them is (Moeller and
 * Trumbore 1997).
 */
function hits({ positions: x, faces }, origin, direction, least) {
  const { x: ox, y: oy, z: oz } = origin,
    { x: dx, y: dy, z: dz } = direction;
  let count = 0,
    nearest = Infinity;
  for (let i = 0; i < faces.length; i += 3) {
    const a = 3 * faces[i],
      b = 3 * faces[i + 1],
      c = 3 * faces[i + 2];
    const ux = x[b] - x[a],
      uy = x[b + 1] - x[a + 1],
      uz = x[b + 2] - x[a + 2];
    const vx = x[c] - x[a],
      vy = x[c + 1] - x[a + 1],
      vz = x[c + 2] - x[a + 2];
    const px = dy * vz - dz * vy,
      py = dz * vx - dx * vz,
      pz = dx * vy - dy * vx;
    const volume = ux * px + uy * py + uz * pz;
    if (volume === 0) continue;
    const tx = ox - x[a],
      ty = oy - x[a + 1],
      tz = oz - x[a + 2];
    const s = (tx * px + ty * py + tz * pz) / volume;
    if (s < 0 || s > 1) continue;
    const qx = ty * uz - tz * uy,
      qy = tz * ux - tx * uz,
      qz = tx * uy - ty * ux;
    const t = (dx * qx + dy * qy + dz * qz) / volume;
    const distance = (vx * qx + vy * qy + vz * qz) / volume;
    if (t < 0 || s + t > 1 || distance <= least) continue;
    ++count;
    nearest = Math.min(nearest, distance);
  }
  return { count, nearest };
}

function candidates(usual, list) {
  const around = [];
  for (const x of [-1, 1]) {
    for (const y of [-1, 1]) around.push(new THREE.Vector3(x, y, 0.7), new THREE.Vector3(x, y, -0.7));
  }
  const own = list
    .flatMap((n) => [n, n.clone().negate()])
    .filter((n) => n.lengthSq() > 0)
    .slice(0, 6);
  // A little aside of a normal, so that what stands upright on a face is not seen from its edge.
  const tilted = own.map((n) => n.clone().normalize().addScaledVector(usual, 0.5));
  return [usual, ...tilted, ...around].filter((d) => d.lengthSq() > 1e-9).map((d) => d.clone().normalize());
}

/** How large triangles look from a direction, from 0 to 1. */
function seenArea(list, direction) {
  const whole = list.reduce((sum, n) => sum + n.length(), 0);
  return whole > 0 ? list.reduce((sum, n) => sum + Math.abs(n.dot(direction)), 0) / whole : 1;
}

/**
 * `corners`: of the faces of either feature; `features`: their vertices; `mesh`: positions of all vertices, faces.
 * Returns centre, radius, direction, and cut: null, or how far before the centre the view begins.
 */
export function aim({ corners, features, point, usual, flat, sceneRadius, mesh }) {
  const centre = point ?? meetingPoint(features);
  const shown = [...corners.flat(), ...features.flat()];
  const own = Math.max(...shown.map((p) => p.distanceTo(centre)), leastPart * sceneRadius);
  const radius = Math.min(context * own, sceneRadius);
  if (flat) return { centre, radius, direction: usual };
  const ofEach = corners.map(normals);
  let best = { score: -Infinity };
  for (const direction of candidates(usual, ofEach.flat())) {
    const before = hits(mesh, centre, direction, 0.02 * own);
    const score =
      Math.min(...ofEach.map((list) => seenArea(list, direction))) -
      hiddenPenalty * before.count +
      0.1 * direction.dot(usual);
    if (score > best.score) best = { score, direction, before };
  }
  // Something is always before it: the view is cut open there.
  const cut = best.before.count > 0 ? Math.min(1.2 * own, 0.9 * best.before.nearest) : null;
  return { centre, radius, direction: best.direction, cut };
}
