// SPDX-License-Identifier: Apache-2.0
//
// Results of noli audit.
import { columnTable, fileName, fold, libraryName, mustBeNone, paragraphs } from "./cards.js";
import { number, pairName, words } from "./dom.js";
import { featureText } from "./features.js";
import { plotGrid, scatter } from "./plots.js";

const count = (head, key = head) => [head, (row) => row[key]];
const nanoseconds = "time per query [ns]";

/** "textbook, tolerance 1e-6"; the tolerance only where libraries were asked with several. */
function nameOf(audit, audits) {
  const several = new Set(audits.map((a) => a.tolerance)).size > 1;
  return libraryName(audit.library) + (several ? `, tolerance ${number(audit.tolerance)}` : "");
}

/** Audits with their times, which stand apart because they differ from run to run. */
const withTimes = (result) => result.audits.map((audit, i) => ({ ...audit, ...result.timing.audits[i], files: audit.files }));

const faultColumns = [
  ["false negatives", (a) => a.false_negatives], ["false positives", (a) => a.false_positives],
  ["late times", (a) => a.late.count], ["worst late [part of step]", (a) => a.late.worst],
  ["median early [part of step]", (a) => a.early.median], ["worst early [part of step]", (a) => a.early.worst],
];
const rareColumns = [
  ["bad times", (a) => a.bad_times, true], ["changed answers", (a) => a.changed, true], ["failures", (a) => a.failures, true],
  ["crashes", (a) => a.crashes, true], ["hangs", (a) => a.hangs, true], ["out of memory", (a) => a.memory, true], ["leaks", (a) => a.leaks, true],
];
const timeColumns = [
  [nanoseconds, (a) => a.ns_per_query], ["time / textbook method", (a) => a.textbook], ["slowest query [ns]", (a) => a.slowest_ns],
];

function ccdPlots(audits) {
  const of = (value) => audits.map((a) => ({ name: nameOf(a, audits), points: [{ x: a.ns_per_query, y: value(a) }] }));
  return [
    scatter("Wrong answers", nanoseconds, "false positives and negatives", of((a) => a.false_positives + a.false_negatives)),
    scatter("Worst error of times of impact", nanoseconds, "late or early [part of step]", of((a) => Math.max(a.late.worst, a.early.worst))),
  ];
}

const grid = (list) => {
  const node = plotGrid([]);
  node.append(...list.filter(Boolean));
  return node.children.length > 0 ? node : null;
};

/** Findings of all files, with the library that has them. */
function ccdFindings(audits) {
  const rows = audits.flatMap((a) => a.files.flatMap((file) => (file.reports ?? []).map((r) => ({ ...r, library: nameOf(a, audits), file: fileName(file.file) }))));
  return columnTable("Findings that are listed", rows, [count("library"), count("file"), ["query, from 1", (r) => r.query], ["finding", (r) => words(r.finding)], ["answer", (r) => r.words]]);
}

function ccdFiles(audits) {
  const rows = audits.flatMap((a) => a.files.map((file) => ({ ...file, library: nameOf(a, audits), name: fileName(file.file) })));
  return fold("By file", columnTable("", rows, [["file", (f) => f.name], count("library"), count("queries"), ...faultColumns, ...rareColumns]));
}

function ccd(result) {
  const audits = withTimes(result);
  return [grid(ccdPlots(audits)),
    columnTable("Libraries, all files", audits, [["library", (a) => libraryName(a.library)], ["tolerance [length]", (a) => a.tolerance], count("queries"), ...faultColumns, ...timeColumns, ...rareColumns]),
    ccdFindings(audits),
    columnTable("Files", result.files, [["file", (f) => fileName(f.file)], ["kind", (f) => pairName(f.kind)], count("queries"), count("contacts"), count("labelled"),
      ["wrong labels", (f) => (f.wrong_labels ?? []).length]]),
    ccdFiles(audits)];
}

const both = (head, key) => [["vertex-face", "vertex_face"], ["edge-edge", "edge_edge"]].map(([name, pair]) => [`${head}, ${name}`, (a) => a[key] && a[key][pair]]);

function pipeline(result) {
  const audits = result.audits.map((audit, i) => ({ ...audit, ...result.timing.audits[i] }));
  const reports = audits.flatMap((a) => (a.reports ?? []).map((r) => ({ ...r, library: nameOf(a, audits) })));
  return [
    grid([scatter("Contacts that were missed", "time of search and queries [s]", "contacts",
      audits.map((a) => ({ name: nameOf(a, audits), points: [{ x: a.search_seconds + a.query_seconds, y: a.false_negatives + a.not_found }] })))]),
    columnTable("Libraries", audits, [["library", (a) => libraryName(a.library)], ["tolerance [length]", (a) => a.tolerance], ...both("candidates", "candidates"),
      ["contacts not found", (a) => a.not_found, true], ["false negatives", (a) => a.false_negatives], ...both("false positives", "false_positives"),
      ["late times", (a) => a.late.count], ["worst late [part of step]", (a) => a.late.worst], ["bad times", (a) => a.bad_times, true], ["failures", (a) => a.failures, true], ["bad pairs", (a) => a.bad_pairs, true],
      ["search [s]", (a) => a.search_seconds], ["queries [s]", (a) => a.query_seconds], ["ended", (a) => words(a.ending)], ["words", (a) => a.words]]),
    columnTable("Findings that are listed", reports, [count("library"), ["contact", (r) => r.features.map((f) => featureText(f)).join(" × ")],
      ["finding", (r) => words(r.finding)], ["answer", (r) => r.words]]),
    columnTable("Frames", result.inputs, [["file", (f) => fileName(f.file)], count("vertices"), count("cells"), count("numbers"), ["SHA-256", (f) => f.sha256]]),
    paragraphs("Notes", result.notes)];
}

function integratorScene(scene, timing) {
  const runs = scene.methods.flatMap((m, i) => m.points.map((p, k) => ({ ...p, method: m.method, seconds: timing.methods[i].seconds[k] })));
  const curve = (value) => scene.methods.map((m) => ({ name: m.method, points: runs.filter((r) => r.method === m.method).map((r) => ({ x: r.seconds, y: value(r) })) }));
  return [
    grid([scatter(`${scene.title}: error of trajectories`, "run time [s]", "error [m]", curve((r) => r.errors && r.errors.trajectory)),
      scatter(`${scene.title}: error of energy`, "run time [s]", "error, relative", curve((r) => r.errors && r.errors.energy))]),
    columnTable(`${scene.title}: ${scene.vertices} vertices, ${scene.windows} windows of ${scene.window_length} s`, runs, [count("method"),
      ["steps / longest allowed", (r) => r.factor], ["least step [s]", (r) => r.least_step], count("events"), ["run time [s]", (r) => r.seconds],
      ["trajectory [m]", (r) => r.errors && r.errors.trajectory], ["energy, relative", (r) => r.errors && r.errors.energy],
      ["momentum, relative", (r) => r.errors && r.errors.momentum], ["angular momentum, relative", (r) => r.errors && r.errors.angular_momentum],
      ["finite", (r) => r.finite]]),
    columnTable("Uncertainty of the reference", [scene.uncertainty], [["trajectory [m]", (u) => u.trajectory], ["energy, relative", (u) => u.energy],
      ["momentum, relative", (u) => u.momentum], ["angular momentum, relative", (u) => u.angular_momentum]])];
}

const precisionName = (run) => `${run.bits} bits${run.binary64 ? ", exponents of double" : ""}`;

/** Sizes of a series over time; 0 has no place on a logarithmic axis. */
const sizes = (rows, key) => rows.map((row) => (Number.isFinite(row[key]) && row[key] !== 0 ? Math.abs(row[key]) : null));

function precisionPlots(result) {
  const times = result.energies.map((e) => e.time);
  const plot = (title, y, series) => ({ title, x: "time [s]", y, log: true, times, series: series.filter((s) => s.values.some((v) => v !== null)) });
  const far = (title, y, key) => plot(title, y, result.runs.filter((run) => run.windows.length === times.length)
    .map((run) => ({ name: precisionName(run), values: sizes(run.windows, key) })));
  return [
    plot("Error of energy", "energy [J]", ["truncation", "rounding"].map((key) => ({ name: key, values: sizes(result.energies, key) }))),
    far("Distance of positions from double", "distance [m]", "position"), far("Difference of energy from double", "energy [J]", "energy"),
  ].filter((p) => p.series.length > 0);
}

const lastOf = (run, key) => (run.windows.length > 0 ? run.windows[run.windows.length - 1][key] : null);

function precision(result) {
  return [plotGrid(precisionPlots(result)),
    columnTable("Precisions, against double", result.runs, [["precision", precisionName], ["greatest distance of a position [m]", (r) => r.greatest_position],
      ["position at the end, rms [m]", (r) => lastOf(r, "position_rms")], ["energy at the end [J]", (r) => lastOf(r, "energy")],
      ["other decisions on impulses", (r) => r.acts && r.acts.count], ["other corners", (r) => r.corners && r.corners.count], ["ended", (r) => r.ended]])];
}

const varied = (row) => row.row.replaceAll("-", " ");

function stability(result) {
  const errors = (key) => result.rows.filter((row) => row.points.length > 1)
    .map((row) => ({ name: varied(row), points: row.points.filter((p) => p.holds).map((p) => ({ x: p.value, y: p[key] })) }));
  return [
    columnTable("What was varied, and how far it holds", result.rows, [["row", varied], ["quantity", (r) => r.varied], ["contact", (r) => r.contact],
      ["points", (r) => r.points.length], ["holds up to", (r) => r.holds_up_to], ["does not hold at", (r) => r.at], ["and then", (r) => r.gives_first && words(r.gives_first)],
      ["exit code", (r) => r.exit_code], ["worst energy error, relative", (r) => Math.max(...r.points.map((p) => p.energy_error ?? 0))],
      ["worst momentum error, relative", (r) => Math.max(...r.points.map((p) => p.momentum_error ?? 0))], ["findings", (r) => r.points.reduce((n, p) => n + p.findings.length, 0)]]),
    fold("Errors of energy as plots", grid(errors("energy_error").map((one) => scatter(one.name, "quantity that is varied", "energy error, relative", [one])))),
    fold("All points", columnTable("", result.rows.flatMap((row) => row.points.map((p) => ({ ...p, row: varied(row) }))), [count("row"), count("value"), count("holds"),
      ["exit code", (p) => p.exit_code], ["energy error, relative", (p) => p.energy_error], ["momentum error, relative", (p) => p.momentum_error],
      ["what it gives", (p) => p.gives], count("message"), count("findings"), ["kept in", (p) => p.saved]]))];
}

export const auditCards = {
  "noli-audit-ccd": {
    title: "Audit of collision detection: answers against the exact truth",
    figures: (r) => [["libraries and tolerances", r.audits.length], ["queries", r.files.reduce((n, f) => n + f.queries, 0)], mustBeNone("findings", r.findings),
      mustBeNone("wrong labels", r.wrong_labels), ["complete", r.complete ? "yes" : "no", r.complete ? undefined : "bad"]],
    body: ccd,
  },
  "noli-audit-pipeline": {
    title: "Audit of collision detection: a whole step",
    figures: (r) => [["contacts, vertex-face", r.contacts.vertex_face], ["contacts, edge-edge", r.contacts.edge_edge], mustBeNone("findings", r.findings),
      ["vertices", r.vertices], ["faces", r.faces], ["noli's own time [s]", r.timing.noli_seconds]],
    body: pipeline,
  },
  "noli-audit-integrator": {
    title: "Audit of the integrator: error against run time",
    figures: (r) => [["scenes", r.scenes.length], ["runs", r.scenes.reduce((n, s) => n + s.methods.reduce((m, one) => m + one.points.length, 0), 0)]],
    body: (r) => r.scenes.flatMap((scene, i) => integratorScene(scene, r.timing.scenes[i])),
  },
  "noli-audit-precision": {
    title: "Audit of precision: double against more digits",
    figures: (r) => [["windows", `${r.windows} of ${r.windows_total}`], ["events", r.events], ["vertices", r.vertices],
      ["order of events changes at [s]", r.order && r.order.changes_at], ["time [s]", r.timing.seconds]],
    body: precision,
  },
  "noli-audit-stability": {
    title: "Audit of stability: how far it holds, and how it ends",
    figures: (r) => [["points", r.points], ["of them hold", r.held], mustBeNone("findings", r.findings), ["allowed energy error", r.most_energy_error],
      ["allowed momentum error", r.most_momentum_error], ["time [s]", r.timing.seconds]],
    body: stability,
  },
  "noli-audit-self": {
    title: "Audit of noli itself",
    figures: (r) => [["parts that held", r.held, "good"], mustBeNone("failed", r.failed), ["skipped", r.skipped], ["seed", r.seed], ["time [s]", r.timing.seconds]],
    body: (r) => [columnTable("Parts", r.parts, [count("group"), ["part", (p) => p.name], count("state"), ["words", (p) => p.words],
      ["figures", (p) => p.figures], ["time [s]", (p) => (r.timing.parts.find((t) => t.group === p.group && t.name === p.name) ?? {}).seconds]])],
  },
};
