// SPDX-License-Identifier: Apache-2.0
//
// Results of noli fuzz.
import { bars, columnTable, mustBeNone, nameOfLibrary } from "./cards.js";
import { number, pairName, words } from "./dom.js";

/** Findings that are listed, by what all fuzzers say of one. */
function findings(result) {
  return columnTable(
    `Findings that are listed: ${number(result.reports.length)} of ${number(result.findings)}`,
    result.reports,
    [
      ["finding", (r) => (r.finding ? words(r.finding) : undefined)],
      ["what was found", (r) => r.words ?? r.difference],
      ["generator", (r) => r.generator],
      ["contact", (r) => r.contact],
      ["others alike", (r) => r.alike],
      ["step", (r) => r.step],
      ["vertices", (r) => r.vertices],
      ["cells", (r) => r.cells],
      ["exit code", (r) => r.exit_code],
      ["run it again", (r) => r.command],
      ["input", (r) => (r.command ? undefined : (r.file ?? r.folder))],
    ],
  );
}

/** Generators with a column for each of their counts. */
function generators(rows, title, columns) {
  return columnTable(title, rows, [["generator", (g) => g.name], ...columns, ["what it looks for", (g) => g.attacks]]);
}

const count = (head, key = head) => [head, (row) => row[key]];
const within = (object, key) => [words(key), (row) => row[object] && row[object][key]];
const keysOf = (rows, object) => [...new Set(rows.flatMap((row) => Object.keys(row[object] ?? {})))];
/** Columns for the counts in a member of the rows; those that are 0 everywhere are left out. */
const countsOf = (rows, object) =>
  keysOf(rows, object)
    .filter((key) => rows.some((row) => row[object][key] > 0))
    .map((key) => within(object, key));

/** {name: {count: n}} as rows. */
const named = (object, inner) => Object.entries(object).map(([name, counts]) => ({ name, [inner]: counts }));

const asked = (result) => [
  ["library", nameOfLibrary(result)],
  ["tolerance", result.tolerance],
];

export const fuzzCards = {
  "noli-fuzz-queries": {
    title: "Fuzzer of queries: the kernel against the oracle",
    figures: (r) => [
      ["queries", r.queries],
      mustBeNone("findings", r.findings),
      ["generators", r.generators.length],
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => [
      bars("Answers, queries", r.answers),
      bars("Decided by stage, queries", r.stages),
      findings(r),
      generators(r.generators, "Queries by generator", [
        ["pair", (g) => pairName(g.pair)],
        count("dimension"),
        ...countsOf(r.generators, "answers"),
      ]),
    ],
  },
  "noli-fuzz-trajectories": {
    title: "Fuzzer of motions: verifier, proof and both checkers",
    figures: (r) => [
      ["motions", r.trajectories],
      mustBeNone("findings", r.findings),
      ["checked by noli_check", r.checked && r.checked.plain],
      ["checked by the verified checker", r.checked && r.checked.verified],
      ["not decided in time", r.undecided],
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => [
      findings(r),
      generators(r.generators, "Motions by generator", [
        count("apart"),
        count("contact"),
        count("without witness", "without_witness"),
        count("undecided"),
      ]),
    ],
  },
  "noli-fuzz-proofs": {
    title: "Fuzzer of proofs: broken proofs, on which both checkers have to agree",
    figures: (r) => [
      ["broken proofs", r.mutants],
      mustBeNone("findings", r.findings),
      ["proofs they come from", r.proofs],
      ["checked by the verified checker too", r.checked_verified],
      ["judged by the oracle", r.judged],
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => {
      const rows = named(r.mutations, "codes");
      return [
        bars("What the checker says, proofs", r.codes),
        findings(r),
        columnTable("Proofs by what was broken", rows, [
          ["what was broken", (m) => m.name],
          ...keysOf(rows, "codes").map((key) => within("codes", key)),
        ]),
      ];
    },
  },
  "noli-fuzz-scenes": {
    title: "Fuzzer of scenes: simulate, verify, check and resume",
    figures: (r) => [
      ["scenes", r.scenes],
      mustBeNone("findings", r.findings),
      ["verified", r.verified],
      ["resumed", r.resumed],
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => {
      const ends = Object.entries(r.ends).flatMap(([name, list]) =>
        Object.entries(list).map(([end, n]) => ({ name: words(name), end: words(end), n })),
      );
      return [
        findings(r),
        columnTable("How scenes end", ends, [
          ["generator", (e) => e.name],
          ["end", (e) => e.end],
          ["scenes", (e) => e.n],
        ]),
      ];
    },
  },
  "noli-fuzz-library-queries": {
    title: "Fuzzer of queries: a library of collision detection",
    figures: (r) => [
      ...asked(r),
      ["queries", r.queries],
      ["contacts", r.contacts],
      mustBeNone("findings", r.findings),
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => [
      bars("Faults, queries", r.faults),
      findings(r),
      generators(r.generators, "Faults by generator", [
        count("asked"),
        count("contacts"),
        ...countsOf(r.generators, "faults"),
      ]),
    ],
  },
  "noli-fuzz-library-trajectories": {
    title: "Fuzzer of motions: a library of collision detection",
    figures: (r) => [
      ...asked(r),
      ["motions", r.trajectories],
      ["contacts", r.contacts],
      ["candidates", r.candidates],
      mustBeNone("findings", r.findings),
      ["with tunnelling", r.through],
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => [
      bars("Faults, pairs of features", r.faults),
      findings(r),
      generators(r.generators, "Faults by generator", [
        count("motions"),
        count("contacts"),
        ...countsOf(r.generators, "faults"),
      ]),
    ],
  },
  "noli-fuzz-replay": {
    title: "A fuzzer input, judged again",
    figures: (r) => [mustBeNone("findings", r.findings)],
    body: (r) => [r.reports ? findings(r) : null],
  },
};
