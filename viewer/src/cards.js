// SPDX-License-Identifier: Apache-2.0
//
// What cards of results are made of: figures, tables with columns that were chosen, bars.
import { element, folded, number } from "./dom.js";
import { more, text } from "./generic.js";

const mostRows = 1000;

/** The few numbers that matter: [name, value, tone], tone "good" or "bad" or nothing. */
export function figures(list) {
  return element(
    "div",
    { className: "figures" },
    ...list
      .filter(([, value]) => value !== undefined && value !== null)
      .map(([name, value, tone]) =>
        element(
          "div",
          { className: `figure ${tone ?? ""}` },
          element("b", {}, typeof value === "number" ? number(value, 4) : String(value)),
          element("span", {}, name),
        ),
      ),
  );
}

/** A count that has to be 0. */
export const mustBeNone = (name, count) => [name, count, count > 0 ? "bad" : "good"];

function bodyCell(value) {
  const content =
    value === undefined || value === null ? "" : typeof value === "number" ? number(value, 4) : text(value);
  const kind = typeof value === "number" ? "number" : content.length > 60 ? "words" : "";
  return element("td", { className: kind }, content);
}

const empty = (value) => value === undefined || value === null || value === "";

/**
 * `columns`: [head, row => value, rare], heads with units. Columns in which no row has anything are left out; those of
 * faults, which are rare, too where all are 0, and are named below.
 */
export function columnTable(title, rows, columns) {
  if (!rows || rows.length === 0) return null;
  const shown = rows.slice(0, mostRows).map((row) => columns.map(([, of]) => of(row)));
  const none = columns.map(([, , rare], i) => Boolean(rare) && shown.every((row) => row[i] === 0));
  const keep = (_, i) => !none[i] && shown.some((row) => !empty(row[i]));
  const right = (i) => shown.every((row) => empty(row[i]) || typeof row[i] === "number");
  const head = columns
    .map(([name], i) => element("th", { scope: "col", className: right(i) ? "number" : "" }, name))
    .filter(keep);
  const left = columns.filter((_, i) => none[i]).map(([name]) => name);
  return element(
    "div",
    {},
    title ? element("h3", {}, title) : null,
    element(
      "div",
      { className: "scroll" },
      element(
        "table",
        { ariaLabel: title ?? "" },
        element("thead", {}, element("tr", {}, ...head)),
        element("tbody", {}, ...shown.map((row) => element("tr", {}, ...row.filter(keep).map(bodyCell)))),
      ),
    ),
    more(rows.length - mostRows),
    left.length > 0 ? element("p", { className: "soft" }, `None: ${left.join(", ")}.`) : null,
  );
}

/** Names and counts as bars; those that are 0 are named below. */
export function bars(title, counts) {
  const entries = Object.entries(counts ?? {}).map(([name, n]) => [name.replaceAll("_", " "), n]);
  const there = entries.filter(([, n]) => n > 0),
    none = entries.filter(([, n]) => n === 0).map(([name]) => name);
  if (entries.length === 0) return null;
  const most = Math.max(...there.map(([, n]) => n), 1);
  const rows = there.flatMap(([name, n]) => {
    const bar = element("i");
    bar.style.width = `${(100 * n) / most}%`;
    return [
      element("dt", {}, name),
      element("dd", {}, element("span", { className: "track" }, bar), element("span", {}, number(n))),
    ];
  });
  return element(
    "div",
    { className: "bars" },
    element("h3", {}, title),
    rows.length > 0 ? element("dl", {}, ...rows) : null,
    none.length > 0 ? element("p", { className: "soft" }, `None: ${none.join(", ")}.`) : null,
  );
}

export const note = (words) => (words ? element("p", {}, words) : null);
export const paragraphs = (title, lines) =>
  lines && lines.length > 0
    ? element("div", {}, element("h3", {}, title), ...lines.map((line) => element("p", {}, line)))
    : null;
export const fold = (title, ...nodes) => folded(title, () => nodes.filter(Boolean));

/** Of a result about a library: "build/plugins/textbook.so" as "textbook". */
export const nameOfLibrary = ({ library: path }) =>
  String(path)
    .split("/")
    .pop()
    .replace(/\.(so|dylib)$/, "");
export const fileName = (path) => String(path).split("/").pop();
