// SPDX-License-Identifier: Apache-2.0
//
// Features and contacts in words.
import { number, words } from "./dom.js";

const names = ["vertex", "edge", "face"];

/** "edge 3-7", or "edge cloth[3]-cloth[7]" where the scene has several parts. */
export function featureText(feature, parts = []) {
  const vertex = (v) => {
    const part = parts.length > 1 ? parts.find((p) => v >= p.first && v < p.first + p.vertices) : null;
    return part ? `${part.name}[${v - part.first}]` : String(v);
  };
  return `${names[feature.length - 1]} ${feature.map(vertex).join("-")}`;
}

/** "cloth and ball"; nothing where they have no names. */
export const bodiesText = ({ bodies = [] }) => bodies.filter(Boolean).join(" and ");

/** "edge 3-7 × vertex 9". */
export const pairText = (contact, parts) => contact.features.map((f) => featureText(f, parts)).join(" × ");

/** What a reader asks first of a contact. `inStep`: times are parts of a step, else seconds. */
export function shortText(contact, parts, inStep) {
  const facts = [
    pairText(contact, parts),
    bodiesText(contact),
    contact.kind && words(contact.kind),
    `${inStep ? "step" : "window"} ${number(contact.step)}`,
  ];
  if (contact.time !== undefined) facts.push(inStep ? `t = ${number(contact.time)}` : `${number(contact.time)} s`);
  return facts.filter(Boolean).join(" · ");
}

/** All that is known of it. */
export function contactText(contact, parts, inStep) {
  const facts = [shortText(contact, parts, inStep)];
  if (contact.cells) facts.push(`cells ${contact.cells.map((cells) => cells.join(", ")).join(" × ")}`);
  if (contact.point) facts.push(`at (${contact.point.map((x) => number(x, 5)).join(", ")})`);
  return facts.join(" · ");
}

const same = (a, b) => a.step === b.step && JSON.stringify(a.features) === JSON.stringify(b.features);

/** The contacts of a page by step and time, with the first one in front, whether or not it is among the listed. */
export function inOrder({ listed, first }, most) {
  const timed = listed.every((c) => c.time !== undefined);
  const sorted = timed ? [...listed].sort((a, b) => a.step - b.step || a.time - b.time) : listed;
  if (!first) return sorted;
  const known = sorted.find((c) => same(c, first));
  return [{ ...known, ...first }, ...sorted.filter((c) => c !== known)].slice(0, most);
}

/** The vertices of a cell by its number: faces come first, then edges, then points. */
function verticesOf(cell, { faces, edges, points }) {
  const edge = cell - faces.length / 3,
    point = edge - edges.length / 2;
  if (edge < 0) return [...faces.subarray(3 * cell, 3 * cell + 3)];
  return point < 0 ? [...edges.subarray(2 * edge, 2 * edge + 2)] : [...points.subarray(point, point + 1)];
}

/** Cells that intersect before anything moves, as contacts of these cells. */
export function intersectionsOf({ intersections = [] }, cells) {
  return intersections
    .map(({ step, cells: [a, b] }) => ({
      step,
      kind: "intersection",
      features: [verticesOf(a, cells), verticesOf(b, cells)],
      cells: [[a], [b]],
      time: 0,
    }))
    .filter(({ features }) => features.every((f) => f.length > 0));
}
