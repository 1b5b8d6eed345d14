// SPDX-License-Identifier: Apache-2.0
//
// Any JSON result as lists and tables, with everything in it: a list of objects becomes a table, one in a row of
// another table a table below that row.
import { element, folded, list, number, words } from "./dom.js";

const mostRows = 1000;
const mostOpen = 2000; // rows of all tables: of more, those in rows are made when they are asked for
const isObject = (x) => x !== null && typeof x === "object" && !Array.isArray(x);
const isTable = (x) => Array.isArray(x) && x.length > 0 && x.every(isObject);
const nothing = (x) =>
  x === null || x === undefined || (Array.isArray(x) && x.length === 0) || (isObject(x) && Object.keys(x).length === 0);

/** "late.worst_relative" as "late, worst relative". */
const title = (key) => words(key).replaceAll(".", ", ");

/** A value as it is read; lists within lists have brackets. */
export function text(x) {
  if (nothing(x)) return "none";
  if (typeof x === "number") return number(x);
  if (typeof x === "boolean") return x ? "yes" : "no";
  if (isObject(x))
    return Object.entries(x)
      .map(([key, value]) => `${words(key)}: ${inner(value)}`)
      .join("; ");
  return Array.isArray(x) ? x.map(inner).join(", ") : String(x);
}

const inner = (x) => (Array.isArray(x) || isObject(x) ? `(${text(x)})` : text(x));

/** {a: {b: 1}} as {"a.b": 1}, so that a row has a column for each. */
function flat(object, prefix = "") {
  return Object.entries(object).flatMap(([key, value]) =>
    isObject(value) ? flat(value, `${prefix}${key}.`) : [[prefix + key, value]],
  );
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
  const details = folded(`${title(key)}: ${number(rows.length)}`, () => [table(rows, open)], open);
  return element("tr", { className: "nested" }, element("td", { colSpan: columns }, details));
}

export const more = (left) => (left > 0 ? element("p", { className: "soft" }, `and ${number(left)} more`) : null);

/** Every member a column, in the order in which they come. */
export function table(rows, open) {
  const shown = rows.slice(0, mostRows).map((row) => flat(row));
  const columns = [
    ...new Set(
      shown
        .flat()
        .filter(([, value]) => !isTable(value))
        .map(([key]) => key),
    ),
  ];
  const numeric = (c) => shown.every((row) => row.every(([key, value]) => key !== c || typeof value === "number"));
  const head = element(
    "tr",
    {},
    ...columns.map((c) => element("th", { scope: "col", className: numeric(c) ? "number" : "" }, title(c))),
  );
  const body = shown.flatMap((row) => {
    const values = new Map(row);
    const tables = row.filter(([, value]) => isTable(value));
    return [
      element("tr", {}, ...columns.map((c) => cell(isTable(values.get(c)) ? undefined : values.get(c)))),
      ...tables.map(([key, value]) => nested(key, value, Math.max(1, columns.length), open)),
    ];
  });
  return element(
    "div",
    {},
    element(
      "div",
      { className: "scroll" },
      element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)),
    ),
    more(rows.length - mostRows),
  );
}

/** Children of a node for all members of an object. */
export function describe(object, depth = 0, open = rowsIn(object) <= mostOpen) {
  const members = Object.entries(object);
  const plain = members.filter(([, value]) => !isTable(value) && (!isObject(value) || nothing(value)));
  const nodes = plain.length > 0 ? [list(plain.map(([key, value]) => [words(key), text(value)]))] : [];
  for (const [key, value] of members) {
    if (isObject(value) && !nothing(value)) {
      const small = depth === 0 && Object.keys(value).length < 40;
      nodes.push(folded(words(key), () => describe(value, depth + 1, open), small));
    } else if (isTable(value)) {
      nodes.push(element(depth === 0 ? "h3" : "h4", {}, words(key)), table(value, open));
    }
  }
  return nodes;
}
