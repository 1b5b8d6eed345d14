// SPDX-License-Identifier: Apache-2.0
//
// Results of simulate, explain, repair, check, ccd, info and reproduce.
import { bars, columnTable, fileName, fold, mustBeNone, note, paragraphs } from "./cards.js";
import { number, pairName, words } from "./dom.js";
import { describe, text } from "./generic.js";

const count = (head, key = head) => [head, (row) => row[key]];
const sum = (counts) => Object.values(counts).reduce((a, b) => a + b, 0);
const pairs = (object) => Object.entries(object).map(([name, value]) => ({ name: words(name), value }));

function simulateEnd(r) {
  const lines = [];
  if (r.first)
    lines.push(`${r.first.names}, ${r.first.kind}, in window ${r.first.window} at ${number(r.first.time)} s.`);
  if (r.too_near && r.too_near.names) lines.push(`Too near: ${r.too_near.names}.`);
  if (r.energy.astray)
    lines.push(
      `The energy goes from ${number(r.energy.astray.begin)} J to ${number(r.energy.astray.there)} J at ${number(r.energy.astray.time)} s.`,
    );
  if (r.proof.ends) lines.push(`The proof ends early: ${r.proof.ends}`);
  return paragraphs("How it ended", lines);
}

function pairLine(name, pair) {
  return pair
    ? `${name}: ${pair.names}, layer ${number(pair.layer)}, ${number(pair.distance)} m apart, at ${number(pair.time)} s.`
    : null;
}

function energyTable(energy) {
  if (!energy) return null;
  const rows = Object.entries(energy.work.kinds).map(([name, work]) => ({ name: words(name), ...work }));
  return columnTable("Work by force", rows, [
    ["force", (w) => w.name],
    ["potential [J]", (w) => w.potential],
    ["damping and friction [J]", (w) => w.damping],
    ["scripts [J]", (w) => w.held],
  ]);
}

function energySummary(energy) {
  if (!energy) return null;
  return columnTable(
    "Energy",
    [energy],
    [
      ["at the beginning [J]", (e) => e.begin],
      ["at the end [J]", (e) => e.last],
      ["least [J]", (e) => e.least],
      ["greatest [J]", (e) => e.greatest],
      ["work of damping [J]", (e) => e.damping_work],
      ["work of restitution [J]", (e) => e.restitution_work],
      ["work of scripts [J]", (e) => e.held_work],
      ["of finite steps [J]", (e) => e.integration],
    ],
  );
}

function obstacleLine(obstacle) {
  if (!obstacle) return null;
  const pair = obstacle.names ? `: ${obstacle.names.join(" and ")}` : "";
  return note(`In step ${number(obstacle.step)} at t = ${number(obstacle.time)} there is no way${pair}.`);
}

/** What a checker was asked, in the words of its claim. */
const claimRows = (claim) =>
  claim
    ? fold(
        "What was claimed",
        columnTable("", pairs(claim), [
          ["condition", (c) => c.name],
          ["value", (c) => text(c.value)],
        ]),
      )
    : null;

/** Members of any kind of file, each under its name. */
const described = (files) => files.map(({ file, ...rest }) => fold(fileName(file), ...describe(rest)));

export const otherCards = {
  "noli-simulate": {
    title: "A simulation",
    figures: (r) => [
      ["simulated [s]", r.time],
      ["windows", `${number(r.windows)} of ${number(r.windows_total)}`],
      mustBeNone("contacts", sum(r.contacts)),
      ["vertices", r.vertices],
      ["cells", r.cells],
      ["energy by finite steps [J]", r.energy.integration],
      ["windows run again", r.roll_backs],
      ["computed in [s]", r.timing.seconds],
    ],
    body: (r) => [simulateEnd(r), note(r.statement), bars("Time by phase [s]", r.timing.phases)],
  },
  "noli-explain-run": {
    title: "A run, explained",
    figures: (r) => [
      ["simulated [s]", r.time],
      ["windows", r.windows],
      ["breakpoints", r.breakpoints],
      ["smallest step [s]", r.smallest_step],
      ["recorded", r.record],
      ["windows run again", (r.roll_backs ?? []).length],
    ],
    body: (r) => [
      paragraphs(
        "Contact",
        [pairLine("Deepest layer", r.deepest), pairLine("Nearest at an impulse", r.nearest)].filter(Boolean),
      ),
      bars("Events", r.events),
      energySummary(r.energy),
      energyTable(r.energy),
      r.timing ? bars("Time by phase [s]", r.timing.phases) : null,
    ],
  },
  "noli-explain-scene": {
    title: "A scene, explained",
    figures: (r) => [
      ["windows", r.windows],
      ["bodies", r.bodies.length],
      ["events per second", r.events_per_second],
      ["about [bytes]", r.bytes],
      mustBeNone("warnings", r.warnings.length),
    ],
    body: (r) => [
      paragraphs("Warnings", r.warnings),
      columnTable("Bodies", r.bodies, [
        ["body", (b) => b.name],
        count("vertices"),
        count("faces"),
        count("edges"),
        ["mass [kg]", (b) => b.mass],
        count("pinned"),
        count("scripted"),
      ]),
      columnTable("Forces", r.groups, [
        ["force", (g) => words(g.force)],
        count("forces"),
        ["shortest step [s]", (g) => g.shortest_step],
        ["longest step [s]", (g) => g.longest_step],
        ["events per second", (g) => g.events_per_second],
      ]),
      columnTable("Contact", r.contact, [
        ["bodies", (c) => c.pairs],
        ["thickness [m]", (c) => c.thickness],
        ["thickness below [m]", (c) => c.thickness_below],
        ["stiffness [N/m]", (c) => c.stiffness],
        ["step [s]", (c) => c.step],
        count("restitution"),
        count("friction"),
      ]),
      paragraphs("What acts", [r.active.join(", ")]),
      columnTable("What is left out", r.left_out, [count("what"), count("why")]),
      r.defaults
        ? fold(
            "Defaults",
            columnTable("", pairs(r.defaults), [
              ["member", (d) => d.name],
              ["value", (d) => text(d.value)],
            ]),
          )
        : null,
    ],
  },
  "noli-repair": {
    title: "A motion, mended",
    figures: (r) => [
      ["steps changed", `${number(r.changed.length)} of ${number(r.steps)}`],
      ["frames", r.frames],
      ["inserted", r.inserted],
      ["as given", r.as_given],
      ["moved by at most", Math.max(0, ...r.changed.map((c) => c.largest))],
      ["gap aimed at", r.thickness],
      ["mean edge", r.mean_edge],
      ["vertices", r.vertices],
      ["fixed", r.fixed],
    ],
    body: (r) => [
      obstacleLine(r.obstacle),
      columnTable("Steps that were changed", r.changed, [
        count("step"),
        count("vertices moved", "moved"),
        count("by at most", "largest"),
        ["root mean square", (c) => c.rms],
        ["moved most", (c) => `vertex ${number(c.vertex)}`],
        count("frames inserted", "inserted"),
        count("deepest layer", "deepest_layer"),
      ]),
      columnTable("Bodies", r.bodies, [
        ["body", (b) => b.name],
        ["moves", (b) => (b.still ? "stands still" : b.fixed ? "as given" : "as contact lets it")],
        count("vertices"),
        count("by at most", "largest"),
        ["root mean square", (b) => b.rms],
      ]),
      paragraphs("Notes", r.notes),
    ],
  },
  "noli-check": {
    title: "A proof, checked",
    figures: (r) => [
      ["proof", fileName(r.proof)],
      ["checker", `${r.checker.name} ${r.checker.version}`],
    ],
    body: (r) => [
      note(String(r.words).split("\n")[0]),
      paragraphs("What makes the claim weaker than the one asked by default", r.weaker),
      paragraphs("Notes", r.notes),
      claimRows(r.claim),
      Object.keys(r.asked ?? {}).length > 0
        ? columnTable("Asked by name", pairs(r.asked), [
            ["condition", (c) => c.name],
            ["value", (c) => c.value],
          ])
        : null,
    ],
  },
  "noli-ccd": {
    title: "Collision queries, decided exactly",
    figures: (r) => [
      ["queries", r.queries],
      ["contacts", r.contacts],
      ["labelled", r.labelled],
      mustBeNone("labels that disagree", r.disagreements),
      [`time per query [ns]`, r.timing.ns_per_query],
    ],
    body: (r) => [
      bars("Decided by stage, queries", r.stages),
      columnTable("Files", r.files, [
        ["file", (f) => fileName(f.file)],
        ["kind", (f) => pairName(f.kind)],
        count("queries"),
        count("contacts"),
        count("labelled"),
        ["labels that disagree", (f) => f.disagreements],
        ["time per query [ns]", (f) => (r.timing.files.find((t) => t.file === f.file) ?? {}).ns_per_query],
      ]),
      ...r.files
        .filter((f) => (f.disagreement_reports ?? []).length > 0)
        .map((f) =>
          fold(`Labels that disagree: ${fileName(f.file)}`, ...describe({ queries: f.disagreement_reports })),
        ),
    ],
  },
  "noli-info": {
    title: "Files, described",
    figures: (r) => [["files", r.files.length]],
    body: (r) => described(r.files),
  },
  "noli-reproduce": {
    title: "A window, integrated again",
    figures: (r) => [
      ["window", r.window],
      ["breakpoints", r.breakpoints],
      ["hashes", r.sha256 === r.expected ? "the same" : "different", r.sha256 === r.expected ? "good" : "bad"],
    ],
    body: (r) => [
      columnTable(
        "SHA-256 of the world lines",
        [r],
        [
          ["computed", (x) => x.sha256],
          ["of the run", (x) => x.expected],
        ],
      ),
    ],
  },
};
