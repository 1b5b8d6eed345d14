// SPDX-License-Identifier: Apache-2.0
//
// Title and verdict. Beside the motion there is room for what decides alone; the rest is folded.
import { element, folded, list, section, words } from "./dom.js";
import { shortText } from "./features.js";

/** Verdicts that one sentence says. */
const plain = ["contact", "no_contact", "proved"];

/** Whether times are parts of steps between frames, and not seconds of a run. */
export const inSteps = ({ scene, statement: rows }) =>
  scene ? scene.unit !== "s" : !rows.some(([name]) => name === "windows");

/** The sentence that is read first. */
function lead(page) {
  const { contacts, focus, scene, verdict } = page;
  if (contacts && contacts.first) {
    const name = contacts.settled === false ? "First contact that was found" : "First contact";
    return `${name}: ${shortText(contacts.first, scene ? scene.parts : [], inSteps(page))}.`;
  }
  if (focus && focus.meets) return focus.words;
  return verdict.lines.find((line) => line.endsWith("intersect before anything moves.")) ?? verdict.lines[0];
}

const paragraph = (text) => element("p", {}, text);

function lines(page) {
  const { word, lines: all, caveats = [] } = page.verdict;
  const first = lead(page);
  if (!page.scene || !plain.includes(word)) return [...new Set([first, ...all])].filter(Boolean).map(paragraph);
  const rest = all.filter((line) => line !== first && !caveats.includes(line));
  return [first, ...caveats]
    .filter(Boolean)
    .map(paragraph)
    .concat(rest.length > 0 ? [folded("More about the verdict", () => rest.map(paragraph))] : []);
}

export function head(page) {
  const { word, tone } = page.verdict;
  return element(
    "header",
    {},
    element(
      "div",
      { className: "title" },
      element("h1", {}, page.title),
      element("span", { className: `badge ${tone}` }, words(word)),
    ),
    ...lines(page),
  );
}

/** What the statement says beyond its defaults; all of it folded. */
export function statement(page) {
  if (page.statement.length === 0) return null;
  const shown = page.statement.filter(([name, , visible]) => visible ?? name === "claim");
  return section(
    "What is stated",
    list(shown),
    folded(`All ${page.statement.length} conditions and inputs`, () => [list(page.statement)]),
  );
}

export function facts(page) {
  const made = element("p", { className: "soft" }, page.made);
  return page.facts.length > 0 ? section("About this report", list(page.facts), made) : element("footer", {}, made);
}
