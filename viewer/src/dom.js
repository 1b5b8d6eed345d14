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

/** `make()` returns the content as a list of nodes; it is called once, when the element is first opened. */
export function folded(title, make, open = false) {
  const details = element("details", {}, element("summary", {}, title));
  let made = false;
  const fill = () => {
    if (made || !details.open) return;
    made = true;
    details.append(...make());
  };
  details.ontoggle = fill;
  details.open = open;
  fill();
  return details;
}

/** Whole numbers in full, others to `digits` digits; with an exponent where there would be too many to be read. */
export function number(x, digits = 6) {
  const size = Math.abs(x);
  if (size >= 1e15 || (size > 0 && size < 1e-4)) return Number(x.toPrecision(digits)).toExponential();
  return x.toLocaleString("en", Number.isInteger(x) ? {} : { maximumSignificantDigits: digits });
}

/** "vertex_face" as "vertex face". */
export const words = (key) => String(key).replaceAll("_", " ");

/** "1 contact", "2 contacts". */
export const counted = (n, one, many = `${one}s`) => `${number(n)} ${n === 1 ? one : many}`;

/** "vertex_face" as "vertex-face". */
export const pairName = (pair) => String(pair).replace("_", "-");
