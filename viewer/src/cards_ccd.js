// SPDX-License-Identifier: Apache-2.0
//
// Results of noli audit ccd: of files of queries, and of whole steps.
import { columnTable, fileName, fold, mustBeNone, nameOfLibrary, paragraphs } from "./cards.js";
import { number, pairName, words } from "./dom.js";
import { featureText } from "./features.js";
import { gridOf, scatter } from "./plots.js";

const count = (head, key = head) => [head, (row) => row[key]];
const nanoseconds = "time per query [ns]";

/** "textbook, tolerance 1e-6"; the tolerance only where libraries were asked with several. */
function nameOf(audit, audits) {
  const several = new Set(audits.map((a) => a.tolerance)).size > 1;
  return nameOfLibrary(audit) + (several ? `, tolerance ${number(audit.tolerance)}` : "");
}

/** Audits with their times, which stand apart because they differ from run to run. */
const withTimes = (result) =>
  result.audits.map((audit, i) => ({ ...audit, ...result.timing.audits[i], files: audit.files }));

const faultColumns = [
  ["false negatives", (a) => a.false_negatives],
  ["false positives", (a) => a.false_positives],
  ["late times", (a) => a.late.count],
  ["worst late [part of step]", (a) => a.late.worst],
  ["median early [part of step]", (a) => a.early.median],
  ["worst early [part of step]", (a) => a.early.worst],
];
const rareColumns = [
  ["bad times", (a) => a.bad_times, true],
  ["changed answers", (a) => a.changed, true],
  ["failures", (a) => a.failures, true],
  ["crashes", (a) => a.crashes, true],
  ["hangs", (a) => a.hangs, true],
  ["out of memory", (a) => a.memory, true],
  ["leaks", (a) => a.leaks, true],
];
const timeColumns = [
  [nanoseconds, (a) => a.ns_per_query],
  ["time / textbook method", (a) => a.textbook],
  ["slowest query [ns]", (a) => a.slowest_ns],
];

function ccdPlots(audits) {
  const of = (value) => audits.map((a) => ({ name: nameOf(a, audits), points: [{ x: a.ns_per_query, y: value(a) }] }));
  return [
    scatter(
      "Wrong answers",
      nanoseconds,
      "false positives and negatives",
      of((a) => a.false_positives + a.false_negatives),
    ),
    scatter(
      "Worst error of times of impact",
      nanoseconds,
      "late or early [part of step]",
      of((a) => Math.max(a.late.worst, a.early.worst)),
    ),
  ];
}

/** Findings of all files, with the library that has them. */
function ccdFindings(audits) {
  const rows = audits.flatMap((a) =>
    a.files.flatMap((file) =>
      (file.reports ?? []).map((r) => ({ ...r, library: nameOf(a, audits), file: fileName(file.file) })),
    ),
  );
  return columnTable("Findings that are listed", rows, [
    count("library"),
    count("file"),
    ["query, from 1", (r) => r.query],
    ["finding", (r) => words(r.finding)],
    ["answer", (r) => r.words],
  ]);
}

function ccdFiles(audits) {
  const rows = audits.flatMap((a) =>
    a.files.map((file) => ({ ...file, library: nameOf(a, audits), name: fileName(file.file) })),
  );
  return fold(
    "By file",
    columnTable("", rows, [
      ["file", (f) => f.name],
      count("library"),
      count("queries"),
      ...faultColumns,
      ...rareColumns,
    ]),
  );
}

function ccd(result) {
  const audits = withTimes(result);
  return [
    gridOf(ccdPlots(audits)),
    columnTable("Libraries, all files", audits, [
      ["library", nameOfLibrary],
      ["tolerance [length]", (a) => a.tolerance],
      count("queries"),
      ...faultColumns,
      ...timeColumns,
      ...rareColumns,
    ]),
    ccdFindings(audits),
    columnTable("Files", result.files, [
      ["file", (f) => fileName(f.file)],
      ["kind", (f) => pairName(f.kind)],
      count("queries"),
      count("contacts"),
      count("labelled"),
      ["wrong labels", (f) => (f.wrong_labels ?? []).length],
    ]),
    ccdFiles(audits),
  ];
}

const both = (head, key) =>
  [
    ["vertex-face", "vertex_face"],
    ["edge-edge", "edge_edge"],
  ].map(([name, pair]) => [`${head}, ${name}`, (a) => a[key] && a[key][pair]]);

function pipeline(result) {
  const audits = result.audits.map((audit, i) => ({ ...audit, ...result.timing.audits[i] }));
  const reports = audits.flatMap((a) => (a.reports ?? []).map((r) => ({ ...r, library: nameOf(a, audits) })));
  return [
    gridOf([
      scatter(
        "Contacts that were missed",
        "time of search and queries [s]",
        "contacts",
        audits.map((a) => ({
          name: nameOf(a, audits),
          points: [{ x: a.search_seconds + a.query_seconds, y: a.false_negatives + a.not_found }],
        })),
      ),
    ]),
    columnTable("Libraries", audits, [
      ["library", nameOfLibrary],
      ["tolerance [length]", (a) => a.tolerance],
      ...both("candidates", "candidates"),
      ["contacts not found", (a) => a.not_found, true],
      ["false negatives", (a) => a.false_negatives],
      ...both("false positives", "false_positives"),
      ["late times", (a) => a.late.count],
      ["worst late [part of step]", (a) => a.late.worst],
      ["bad times", (a) => a.bad_times, true],
      ["failures", (a) => a.failures, true],
      ["bad pairs", (a) => a.bad_pairs, true],
      ["search [s]", (a) => a.search_seconds],
      ["queries [s]", (a) => a.query_seconds],
      ["ended", (a) => words(a.ending)],
      ["words", (a) => a.words],
    ]),
    columnTable("Findings that are listed", reports, [
      count("library"),
      ["contact", (r) => r.features.map((f) => featureText(f)).join(" × ")],
      ["finding", (r) => words(r.finding)],
      ["answer", (r) => r.words],
    ]),
    columnTable("Frames", result.inputs, [
      ["file", (f) => fileName(f.file)],
      count("vertices"),
      count("cells"),
      count("numbers"),
      ["SHA-256", (f) => f.sha256],
    ]),
    paragraphs("Notes", result.notes),
  ];
}

export const ccdCards = {
  "noli-audit-ccd": {
    title: "Audit of collision detection: answers against the exact truth",
    figures: (r) => [
      ["libraries and tolerances", r.audits.length],
      ["queries", r.files.reduce((n, f) => n + f.queries, 0)],
      mustBeNone("findings", r.findings),
      mustBeNone("wrong labels", r.wrong_labels),
      ["complete", r.complete ? "yes" : "no", r.complete ? undefined : "bad"],
    ],
    body: ccd,
  },
  "noli-audit-pipeline": {
    title: "Audit of collision detection: a whole step",
    figures: (r) => [
      ["contacts, vertex-face", r.contacts.vertex_face],
      ["contacts, edge-edge", r.contacts.edge_edge],
      mustBeNone("findings", r.findings),
      ["vertices", r.vertices],
      ["faces", r.faces],
      ["noli's own time [s]", r.timing.noli_seconds],
    ],
    body: pipeline,
  },
};
