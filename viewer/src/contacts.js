// SPDX-License-Identifier: Apache-2.0
//
// The contacts of a verdict: how many there are of each kind, and a list, a click on which shows one.
import { counted, element, number, pairName, words } from "./dom.js";
import { bodiesText, pairText } from "./features.js";

function cells(contact, parts) {
  const cell = (text, className = "") => element("td", { className }, text);
  const time = contact.time === undefined ? "" : number(contact.time, 4);
  const facts = [contact.kind && words(contact.kind), bodiesText(contact)].filter(Boolean).join(", ");
  return [
    cell(number(contact.step), "number"),
    cell(time, "number"),
    element(
      "td",
      { className: "pair" },
      pairText(contact, parts),
      facts ? element("span", { className: "soft" }, facts) : null,
    ),
  ];
}

/** Keeps one row of a list chosen and in the order of tabs; arrows move within the list. */
class Rows {
  constructor(rows, pick) {
    this.rows = rows;
    this.pick = pick;
    rows.forEach((row, i) => {
      row.tabIndex = i === 0 ? 0 : -1;
      row.onclick = () => {
        this.choose(i);
        pick(i);
      };
      row.onkeydown = (event) => this.key(event, i);
    });
  }

  key(event, i) {
    const to = { ArrowDown: i + 1, ArrowUp: i - 1, Home: 0, End: this.rows.length - 1 }[event.key];
    if (event.key === "Enter" || event.key === " ") this.rows[i].click();
    else if (to !== undefined && this.rows[to]) this.rows[to].focus();
    else return;
    event.preventDefault();
  }

  choose(i) {
    const before = this.rows[this.chosen];
    for (const row of [before, this.rows[i]]) {
      if (!row) continue;
      const now = row === this.rows[i];
      row.classList.toggle("picked", now);
      row.ariaSelected = now;
      row.tabIndex = now ? 0 : -1;
    }
    if (before === undefined && i !== 0) this.rows[0].tabIndex = -1;
    this.chosen = i;
  }
}

function summary(contacts) {
  const kinds = Object.entries(contacts.counts)
    .filter(([, n]) => n > 0)
    .map(([kind, n]) => `${number(n)} ${pairName(kind)}`);
  const initial =
    contacts.initial > 0 ? `; ${counted(contacts.initial, "pair")} of cells intersect before anything moves` : "";
  return `${counted(contacts.total, "pair")} of features${kinds.length > 0 ? `: ${kinds.join(", ")}` : ""}${initial}.`;
}

/** `list`: in order; `pick(contact)` is called with one of them. Returns {node, choose(contact)}. */
export function contactList(contacts, list, parts, inStep, pick) {
  const rows = list.map((contact) => element("tr", { className: "pick" }, ...cells(contact, parts)));
  const chooser = new Rows(rows, (i) => pick(list[i]));
  const head = element(
    "tr",
    {},
    ...[inStep ? "step" : "window", inStep ? "time" : "time [s]", "features, by vertex"].map((h) =>
      element("th", { scope: "col" }, h),
    ),
  );
  const left = contacts.total + contacts.initial - list.length;
  const node = element(
    "div",
    { className: "contacts" },
    element("h2", {}, "Contacts"),
    element("p", { className: "soft" }, summary(contacts)),
  );
  if (list.length > 0) {
    node.append(
      element(
        "div",
        { className: "scroll", tabIndex: -1 },
        element("table", { ariaLabel: "Contacts" }, element("thead", {}, head), element("tbody", {}, ...rows)),
      ),
    );
  }
  if (left > 0)
    node.append(element("p", { className: "soft" }, list.length > 0 ? `and ${number(left)} more` : "None is listed."));
  const choose = (contact) => {
    const i = list.indexOf(contact);
    if (i >= 0) chooser.choose(i);
  };
  return { node, choose };
}
