// SPDX-License-Identifier: Apache-2.0
//
// Any JSON result as lists and tables: what is a list of objects becomes a table.
import { element, list, number } from "./dom.js";

const mostRows = 1000;
const isObject = (x) => x !== null && typeof x === "object" && !Array.isArray(x);
const plain = (x) => (Array.isArray(x) ? x.every((y) => y === null || typeof y !== "object") : x === null || typeof x !== "object");

function text(x) {
  if (typeof x === "number") return number(x);
  if (Array.isArray(x)) return x.map(text).join(", ");
  return x === null ? "none" : String(x);
}

/** {a: {b: 1}} as {"a.b": 1}, so that a row has a column for each. */
function flat(object, prefix = "") {
  return Object.entries(object).flatMap(([key, value]) =>
    isObject(value) ? flat(value, `${prefix}${key}.`) : [[prefix + key, value]]);
}

function table(rows) {
  const flatRows = rows.slice(0, mostRows).map((row) => new Map(flat(row).filter(([, value]) => plain(value))));
  const columns = [...new Set(flatRows.flatMap((row) => [...row.keys()]))];
  const head = element("tr", {}, ...columns.map((c) => element("th", {}, c.replaceAll("_", " "))));
  const body = flatRows.map((row) => element("tr", {}, ...columns.map((c) =>
    element("td", { className: typeof row.get(c) === "number" ? "number" : "" }, row.has(c) ? text(row.get(c)) : ""))));
  return element("div", {}, element("div", { className: "scroll" },
    element("table", {}, element("thead", {}, head), element("tbody", {}, ...body))),
    rows.length > mostRows ? element("p", { className: "soft" }, `and ${number(rows.length - mostRows)} more`) : null);
}

/** Children of a node for all members of an object. */
export function describe(object, depth = 0) {
  const plainOnes = Object.entries(object).filter(([, value]) => plain(value));
  const nodes = plainOnes.length > 0 ? [list(plainOnes.map(([key, value]) => [key.replaceAll("_", " "), text(value)]))] : [];
  for (const [key, value] of Object.entries(object)) {
    if (plain(value)) continue;
    const title = element(depth === 0 ? "h3" : "h4", {}, key.replaceAll("_", " "));
    if (isObject(value)) {
      nodes.push(element("details", { open: depth === 0 && Object.keys(value).length < 40 }, element("summary", {}, key.replaceAll("_", " ")), ...describe(value, depth + 1)));
    } else if (value.every(isObject)) {
      nodes.push(title, table(value));
    } else {
      nodes.push(title, element("p", {}, text(value.slice(0, mostRows).map((x) => JSON.stringify(x)))));
    }
  }
  return nodes;
}
