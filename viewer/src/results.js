// SPDX-License-Identifier: Apache-2.0
//
// A result of noli as a card: verdict, the numbers that matter, plots and tables. What no card knows has lists and
// tables of all its members; those that a card leaves out are folded below it.
import { auditCards } from "./cards_audit.js";
import { ccdCards } from "./cards_ccd.js";
import { figures } from "./cards.js";
import { fuzzCards } from "./cards_fuzz.js";
import { otherCards } from "./cards_others.js";
import { element, folded, words } from "./dom.js";
import { describe } from "./generic.js";

const cards = { ...fuzzCards, ...auditCards, ...ccdCards, ...otherCards };

/** Of a card; nothing where the result is not as this version of noli writes it. */
function contentOf(card, result) {
  try {
    return [figures(card.figures(result)), ...card.body(result).filter(Boolean)];
  } catch (error) {
    console.warn(`The card of ${result.schema} cannot show this result: ${error.message}`);
    return null;
  }
}

function headOf(title, name, { verdict }, tone) {
  const badge =
    typeof verdict === "string" ? element("span", { className: `badge ${tone ?? ""}` }, words(verdict)) : null;
  return element(
    "div",
    { className: "title" },
    element("h2", {}, title),
    badge,
    element("span", { className: "soft" }, name),
  );
}

export function resultSection({ name, tone, result }) {
  const card = Object.hasOwn(cards, result.schema) ? cards[result.schema] : null;
  const content = card ? contentOf(card, result) : null;
  if (!content) return element("section", { className: "card" }, headOf(name, "", result, tone), ...describe(result));
  return element(
    "section",
    { className: "card" },
    headOf(card.title, name, result, tone),
    ...content,
    folded(`Everything in ${name}`, () => describe(result)),
  );
}
