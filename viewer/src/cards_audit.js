// SPDX-License-Identifier: Apache-2.0
//
// Results of noli audit integrator, precision, stability and self.
import { columnTable, fold, mustBeNone } from "./cards.js";
import { words } from "./dom.js";
import { gridOf, plotGrid, scatter } from "./plots.js";

const count = (head, key = head) => [head, (row) => row[key]];

function integratorScene(scene, timing) {
  const runs = scene.methods.flatMap((m, i) =>
    m.points.map((p, k) => ({ ...p, method: m.method, seconds: timing.methods[i].seconds[k] })),
  );
  const curve = (value) =>
    scene.methods.map((m) => ({
      name: m.method,
      points: runs.filter((r) => r.method === m.method).map((r) => ({ x: r.seconds, y: value(r) })),
    }));
  return [
    gridOf([
      scatter(
        `${scene.title}: error of trajectories`,
        "run time [s]",
        "error [m]",
        curve((r) => r.errors && r.errors.trajectory),
      ),
      scatter(
        `${scene.title}: error of energy`,
        "run time [s]",
        "error, relative",
        curve((r) => r.errors && r.errors.energy),
      ),
    ]),
    columnTable(
      `${scene.title}: ${scene.vertices} vertices, ${scene.windows} windows of ${scene.window_length} s`,
      runs,
      [
        count("method"),
        ["steps / longest allowed", (r) => r.factor],
        ["least step [s]", (r) => r.least_step],
        count("events"),
        ["run time [s]", (r) => r.seconds],
        ["trajectory [m]", (r) => r.errors && r.errors.trajectory],
        ["energy, relative", (r) => r.errors && r.errors.energy],
        ["momentum, relative", (r) => r.errors && r.errors.momentum],
        ["angular momentum, relative", (r) => r.errors && r.errors.angular_momentum],
        ["finite", (r) => r.finite],
      ],
    ),
    columnTable(
      "Uncertainty of the reference",
      [scene.uncertainty],
      [
        ["trajectory [m]", (u) => u.trajectory],
        ["energy, relative", (u) => u.energy],
        ["momentum, relative", (u) => u.momentum],
        ["angular momentum, relative", (u) => u.angular_momentum],
      ],
    ),
  ];
}

const precisionName = (run) => `${run.bits} bits${run.binary64 ? ", exponents of double" : ""}`;

/** Sizes of a series over time; 0 has no place on a logarithmic axis. */
const sizes = (rows, key) =>
  rows.map((row) => (Number.isFinite(row[key]) && row[key] !== 0 ? Math.abs(row[key]) : null));

function precisionPlots(result) {
  const times = result.energies.map((e) => e.time);
  const plot = (title, y, series) => ({
    title,
    x: "time [s]",
    y,
    log: true,
    times,
    series: series.filter((s) => s.values.some((v) => v !== null)),
  });
  const far = (title, y, key) =>
    plot(
      title,
      y,
      result.runs
        .filter((run) => run.windows.length === times.length)
        .map((run) => ({ name: precisionName(run), values: sizes(run.windows, key) })),
    );
  return [
    plot(
      "Error of energy",
      "energy [J]",
      ["truncation", "rounding"].map((key) => ({ name: key, values: sizes(result.energies, key) })),
    ),
    far("Distance of positions from double", "distance [m]", "position"),
    far("Difference of energy from double", "energy [J]", "energy"),
  ].filter((p) => p.series.length > 0);
}

const lastOf = (run, key) => (run.windows.length > 0 ? run.windows[run.windows.length - 1][key] : null);

function precision(result) {
  return [
    plotGrid(precisionPlots(result)),
    columnTable("Precisions, against double", result.runs, [
      ["precision", precisionName],
      ["greatest distance of a position [m]", (r) => r.greatest_position],
      ["position at the end, rms [m]", (r) => lastOf(r, "position_rms")],
      ["energy at the end [J]", (r) => lastOf(r, "energy")],
      ["other decisions on impulses", (r) => r.acts && r.acts.count],
      ["other corners", (r) => r.corners && r.corners.count],
      ["ended", (r) => r.ended],
    ]),
  ];
}

const varied = (row) => row.row.replaceAll("-", " ");

function stability(result) {
  const errors = (key) =>
    result.rows
      .filter((row) => row.points.length > 1)
      .map((row) => ({
        name: varied(row),
        points: row.points.filter((p) => p.holds).map((p) => ({ x: p.value, y: p[key] })),
      }));
  return [
    columnTable("What was varied, and how far it holds", result.rows, [
      ["row", varied],
      ["quantity", (r) => r.varied],
      ["contact", (r) => r.contact],
      ["points", (r) => r.points.length],
      ["holds up to", (r) => r.holds_up_to],
      ["does not hold at", (r) => r.at],
      ["and then", (r) => r.gives_first && words(r.gives_first)],
      ["exit code", (r) => r.exit_code],
      ["worst energy error, relative", (r) => Math.max(...r.points.map((p) => p.energy_error ?? 0))],
      ["worst momentum error, relative", (r) => Math.max(...r.points.map((p) => p.momentum_error ?? 0))],
      ["findings", (r) => r.points.reduce((n, p) => n + p.findings.length, 0)],
    ]),
    fold(
      "Errors of energy as plots",
      gridOf(
        errors("energy_error").map((one) =>
          scatter(one.name, "quantity that is varied", "energy error, relative", [one]),
        ),
      ),
    ),
    fold(
      "All points",
      columnTable(
        "",
        result.rows.flatMap((row) => row.points.map((p) => ({ ...p, row: varied(row) }))),
        [
          count("row"),
          count("value"),
          count("holds"),
          ["exit code", (p) => p.exit_code],
          ["energy error, relative", (p) => p.energy_error],
          ["momentum error, relative", (p) => p.momentum_error],
          ["what it gives", (p) => p.gives],
          count("message"),
          count("findings"),
          ["kept in", (p) => p.saved],
        ],
      ),
    ),
  ];
}

export const auditCards = {
  "noli-audit-integrator": {
    title: "Audit of the integrator: error against run time",
    figures: (r) => [
      ["scenes", r.scenes.length],
      ["runs", r.scenes.reduce((n, s) => n + s.methods.reduce((m, one) => m + one.points.length, 0), 0)],
    ],
    body: (r) => r.scenes.flatMap((scene, i) => integratorScene(scene, r.timing.scenes[i])),
  },
  "noli-audit-precision": {
    title: "Audit of precision: double against more digits",
    figures: (r) => [
      ["windows", `${r.windows} of ${r.windows_total}`],
      ["events", r.events],
      ["vertices", r.vertices],
      ["order of events changes at [s]", r.order && r.order.changes_at],
      ["time [s]", r.timing.seconds],
    ],
    body: precision,
  },
  "noli-audit-stability": {
    title: "Audit of stability: how far it holds, and how it ends",
    figures: (r) => [
      ["points", r.points],
      ["of them hold", r.held],
      mustBeNone("findings", r.findings),
      ["allowed energy error", r.most_energy_error],
      ["allowed momentum error", r.most_momentum_error],
      ["time [s]", r.timing.seconds],
    ],
    body: stability,
  },
  "noli-audit-self": {
    title: "Audit of noli itself",
    figures: (r) => [
      ["parts that held", r.held, "good"],
      mustBeNone("failed", r.failed),
      ["skipped", r.skipped],
      ["seed", r.seed],
      ["time [s]", r.timing.seconds],
    ],
    body: (r) => [
      columnTable("Parts", r.parts, [
        count("group"),
        ["part", (p) => p.name],
        count("state"),
        ["words", (p) => p.words],
        ["figures", (p) => p.figures],
        ["time [s]", (p) => (r.timing.parts.find((t) => t.group === p.group && t.name === p.name) ?? {}).seconds],
      ]),
    ],
  },
};
