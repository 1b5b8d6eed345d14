// SPDX-License-Identifier: Apache-2.0

/** An element with properties and children; text needs no escaping. */
export function element(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** Pairs of a name and a text. */
export function list(pairs) {
  return element("dl", {}, ...pairs.flatMap(([name, text]) => [element("dt", {}, name), element("dd", {}, text)]));
}

export function section(title, ...children) {
  return element("section", {}, element("h2", {}, title), ...children);
}

/** Whole numbers in full, others to six digits; with an exponent where there would be too many digits to be read. */
export function number(x) {
  const size = Math.abs(x);
  if (size >= 1e15 || (size > 0 && size < 1e-4)) return Number(x.toPrecision(6)).toExponential();
  return Number.isInteger(x) ? x.toLocaleString("en") : Number(x.toPrecision(6)).toString();
}
