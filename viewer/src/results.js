// SPDX-License-Identifier: Apache-2.0
//
// Any JSON result as lists and tables, with everything in it: a list of objects becomes a table, one in a row of
// another table a table below that row.
import { element, list, number } from "./dom.js";

const mostRows = 1000;
const mostOpen = 2000;  // rows of all tables: of more, those in rows are made when they are asked for
const isObject = (x) => x !== null && typeof x === "object" && !Array.isArray(x);
const isTable = (x) => Array.isArray(x) && x.length > 0 && x.every(isObject);
const words = (key) => key.replaceAll("_", " ");

/** Of anything but an object or a table. */
function text(x) {
  if (typeof x === "number") return number(x);
  if (typeof x === "boolean") return x ? "yes" : "no";
  if (!Array.isArray(x)) return x === null ? "none" : String(x);
  if (x.length === 0) return "none";
  return x.map((y) => (y !== null && typeof y === "object" ? JSON.stringify(y) : text(y))).join(", ");
}

/** {a: {b: 1}} as {"a.b": 1}, so that a row has a column for each. */
function flat(object, prefix = "") {
  return Object.entries(object).flatMap(([key, value]) =>
    isObject(value) ? flat(value, `${prefix}${key}.`) : [[prefix + key, value]]);
}

/** How many rows the tables of a result have. */
function rowsIn(x) {
  if (x === null || typeof x !== "object") return 0;
  return (isTable(x) ? x.length : 0) + Object.values(x).reduce((sum, y) => sum + rowsIn(y), 0);
}

function cell(x) {
  const content = x === undefined ? "" : text(x);
  const kind = typeof x === "number" ? "number" : content.length > 60 ? "words" : "";
  return element("td", { className: kind }, content);
}

/** A table in a row: made when it is first seen. */
function nested(key, rows, columns, open) {
  const details = element("details", {}, element("summary", {}, `${words(key)}: ${number(rows.length)}`));
  const make = () => { if (details.children.length === 1) details.append(table(rows, open)); };
  details.ontoggle = make;
  if (open) make();
  details.open = open;
  return element("tr", { className: "nested" }, element("td", { colSpan: columns }, details));
}

const more = (left) => (left > 0 ? element("p", { className: "soft" }, `and ${number(left)} more`) : null);

function table(rows, open) {
  const shown = rows.slice(0, mostRows).map((row) => flat(row));
  const columns = [...new Set(shown.flat().filter(([, value]) => !isTable(value)).map(([key]) => key))];
  const head = element("tr", {}, ...columns.map((c) => element("th", {}, words(c))));
  const body = shown.flatMap((row) => {
    const values = new Map(row);
    const tables = row.filter(([, value]) => isTable(value));
    return [element("tr", {}, ...columns.map((c) => cell(isTable(values.get(c)) ? undefined : values.get(c)))),
      ...tables.map(([key, value]) => nested(key, value, Math.max(1, columns.length), open))];
  });
  return element("div", {}, element("div", { className: "scroll" },
    element("table", {}, element("thead", {}, head), element("tbody", {}, ...body))), more(rows.length - mostRows));
}

/** Children of a node for all members of an object. */
export function describe(object, depth = 0, open = rowsIn(object) <= mostOpen) {
  const members = Object.entries(object);
  const plain = members.filter(([, value]) => !isObject(value) && !isTable(value));
  const nodes = plain.length > 0 ? [list(plain.map(([key, value]) => [words(key), text(value)]))] : [];
  for (const [key, value] of members) {
    if (isObject(value)) {
      nodes.push(element("details", { open: depth === 0 && Object.keys(value).length < 40 },
        element("summary", {}, words(key)), ...describe(value, depth + 1, open)));
    } else if (isTable(value)) {
      nodes.push(element(depth === 0 ? "h3" : "h4", {}, words(key)), table(value, open));
    }
  }
  return nodes;
}
