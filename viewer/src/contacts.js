// SPDX-License-Identifier: Apache-2.0
//
// The contacts of a verdict: how many there are of each kind, and a list, a click on which shows one.
import { element, list, number, section } from "./dom.js";

const featureNames = ["vertex", "edge", "face"];
const text = (feature) => `${featureNames[feature.length - 1]} ${feature.join("-")}`;

/** `pick(contact)` is called with one of contacts.listed. */
export function contactSection(contacts, pick) {
  const kinds = Object.entries(contacts.counts).map(([kind, n]) => [kind.replace("_", " and "), number(n)]);
  const counted = list([["all pairs of features", number(contacts.total)], ...kinds,
    ["cells that intersect from the beginning", number(contacts.initial)]]);
  if (contacts.listed.length === 0) return section("Contacts", counted);
  let picked = null;
  const rows = contacts.listed.map((contact, i) => {
    const row = element("tr", { className: "pick", tabIndex: 0 }, element("td", { className: "number" }, String(i + 1)),
      element("td", { className: "number" }, String(contact.step)), element("td", {}, contact.pair.replace("_", " and ")),
      element("td", {}, `${text(contact.features[0])} meets ${text(contact.features[1])}`));
    const choose = () => {
      if (picked) picked.classList.remove("picked");
      picked = row;
      row.classList.add("picked");
      pick(contact);
    };
    row.onclick = choose;
    row.onkeydown = (event) => { if (event.key === "Enter") choose(); };
    return row;
  });
  const head = element("tr", {}, ...["", "step", "pair", "features, by vertex"].map((h) => element("th", {}, h)));
  const left = contacts.total - contacts.listed.length;
  return section("Contacts", counted, element("h3", {}, "First ones found"),
    element("div", { className: "scroll" }, element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows))),
    left > 0 ? element("p", { className: "soft" }, `and ${number(left)} more`) : null);
}
