// SPDX-License-Identifier: Apache-2.0
//
// Plots: series over time, bars over steps, points of two quantities on logarithmic axes.
import uPlot from "uplot";
import { element, section } from "./dom.js";

const strokes = ["#1c2330", "#3b78c4", "#d07a2d", "#3f9c6b", "#8e63b8", "#c0567a", "#5f8f9f", "#a2902f"];
const height = 260;
const mostBars = 500;
const contactRed = "#d8102a";

/** So that an axis tells small differences of large numbers. */
const label = (value) => (value === null || value === undefined ? "" : Number(value.toPrecision(7)).toString());

// Logarithmic axes are linear ones of logarithms: those of uPlot end with magnitudes that doubles can have.
const log = (values) => values.map((x) => (x !== null && x > 0 ? Math.log10(x) : null));
const power = (exponent) =>
  Number.isInteger(exponent)
    ? `1e${exponent}`
    : Number((10 ** exponent).toPrecision(2))
        .toExponential()
        .replace("e+", "e");
const decades = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200];
const wholes = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000, 100000];

const stroke = (i) => strokes[i % strokes.length];

const grid = { stroke: "#e4e8ee", width: 1 };
const value = (isLog) => (_, x) => (x === null ? "" : isLog ? power(x) : label(x));

function axis(name, size, isLog, whole = false) {
  return {
    label: name,
    size,
    grid,
    ticks: grid,
    ...(isLog ? { incrs: decades } : whole ? { incrs: wholes } : {}),
    values: (_, ticks) => ticks.map(isLog ? power : label),
  };
}

function seriesOf(plot) {
  const points = plot.points ? { show: true, size: 8 } : plot.bars ? { show: false } : {};
  const paths = plot.bars
    ? { paths: uPlot.paths.bars({ size: [0.9, 40] }), fill: contactRed, stroke: contactRed, width: 0 }
    : {};
  return plot.series.map(({ name }, i) => ({
    label: name,
    stroke: stroke(i),
    width: 1.4,
    value: value(plot.log),
    spanGaps: Boolean(plot.points),
    points,
    ...paths,
  }));
}

function scalesOf(plot) {
  const x = { time: false },
    y = {};
  if (plot.bars) {
    const half = plot.times.length > 1 ? (plot.times[1] - plot.times[0]) / 2 : 0.5;
    x.range = (_, least, most) => [least - half, most + half];
    y.range = (_, __, most) => [0, Math.max(1, 1.05 * most)];
  }
  return { x, y };
}

/** `plot`: x, y, log, times, series [{name, values}]; and logX, points, bars. */
function draw(plot, place, pick) {
  const options = {
    width: place.clientWidth,
    height,
    cursor: { drag: { x: !plot.points, y: false } },
    scales: scalesOf(plot),
    axes: [axis(plot.x, 44, plot.logX, plot.times.every(Number.isInteger)), axis(plot.y, plot.log ? 64 : 84, plot.log)],
    series: [{ label: plot.points ? "" : plot.x, value: value(plot.logX) }, ...seriesOf(plot)],
    legend: { live: !plot.points, show: !plot.bars },
    hooks: pick ? { ready: [(u) => u.over.addEventListener("click", () => pick(u.posToVal(u.cursor.left, "x")))] } : {},
  };
  const data = [
    plot.logX ? log(plot.times) : plot.times,
    ...plot.series.map((s) => (plot.log ? log(s.values) : s.values)),
  ];
  const chart = new uPlot(options, data, place);
  new ResizeObserver(() => chart.setSize({ width: place.clientWidth, height })).observe(place);
}

/** A plot that is drawn when it is first seen, or by drawPlots(). */
export function plotNode(plot, pick) {
  const place = element(
    "div",
    { className: "plot", role: "img", ariaLabel: `${plot.title}: ${plot.y} against ${plot.x}` },
    element("h3", {}, plot.title),
  );
  const wait = new ResizeObserver(() => place.draw());
  place.draw = () => {
    if (place.clientWidth === 0 || place.drawn) return;
    place.drawn = true;
    wait.disconnect();
    draw(plot, place, pick);
  };
  wait.observe(place);
  return place;
}

/** All that are in the page and not folded. */
export const drawPlots = () => document.querySelectorAll(".plot").forEach((place) => place.draw());

export const plotGrid = (plots, pick) =>
  element("div", { className: "plots" }, ...plots.map((plot) => plotNode(plot, pick)));

export function plotSection(plots, pick) {
  return section("Over time", plotGrid(plots, pick));
}

/** Points {x, y} of several series on logarithmic axes; points that are not above 0 have no place there. */
export function scatter(title, x, y, series) {
  const positive = series
    .map(({ name, points }) => ({ name, points: points.filter((p) => p.x > 0 && p.y > 0) }))
    .filter((s) => s.points.length > 0);
  if (positive.length === 0) return null;
  const all = [...new Set(positive.flatMap((s) => s.points.map((p) => p.x)))].sort((a, b) => a - b);
  const values = (points) => {
    const at = new Map(points.map((p) => [p.x, p.y]));
    return all.map((place) => at.get(place) ?? null);
  };
  return plotNode({
    title,
    x,
    y,
    log: true,
    logX: true,
    points: true,
    times: all,
    series: positive.map(({ name, points }) => ({ name, values: values(points) })),
  });
}

/** Contacts of each step as bars; of very many steps some together. `pick(step)` is called on a click. */
export function contactBars(perStep, unit, pick) {
  const together = Math.ceil(perStep.length / mostBars);
  const steps = [],
    sums = [];
  perStep.forEach((n, i) => {
    if (i % together === 0) {
      steps.push(i + 1);
      sums.push(0);
    }
    sums[sums.length - 1] += n;
  });
  const x = together > 1 ? `${unit}, ${together} together from` : unit;
  return section(
    `Contacts by ${unit}`,
    plotNode(
      {
        title: "Pairs of features that meet",
        x,
        y: "contacts",
        log: false,
        bars: true,
        times: steps,
        series: [{ name: "contacts", values: sums }],
      },
      (at) => pick(Math.max(1, Math.round(at))),
    ),
  );
}

/** Plots that are there, side by side; null where none is. */
export function gridOf(nodes) {
  const there = nodes.filter(Boolean);
  return there.length > 0 ? element("div", { className: "plots" }, ...there) : null;
}
