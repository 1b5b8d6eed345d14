// SPDX-License-Identifier: Apache-2.0
//
// Series over time. A click shows that time.
import uPlot from "uplot";
import { element, section } from "./dom.js";

const strokes = ["#1c2330", "#3b78c4", "#d07a2d", "#3f9c6b", "#8e63b8", "#c0567a", "#5f8f9f", "#a2902f"];

/** So that an axis tells small differences of large numbers. */
const label = (value) => (value === null ? "" : Number(value.toPrecision(7)).toString());

function draw(plot, place, pick) {
  const height = 260;
  const options = {
    width: place.clientWidth,
    height,
    cursor: { drag: { x: true, y: false } },
    scales: { x: { time: false }, y: { distr: plot.log ? 3 : 1 } },
    axes: [{ label: plot.x, size: 44 }, { label: plot.y, size: 84, values: (_, ticks) => ticks.map(label) }],
    series: [{ label: plot.x, value: (_, x) => label(x) },
      ...plot.series.map(({ name }, i) => ({ label: name, stroke: strokes[i % strokes.length], width: 1.4,
                                             value: (_, y) => label(y), spanGaps: false }))],
    hooks: { ready: [(u) => u.over.addEventListener("click", () => pick(u.posToVal(u.cursor.left, "x")))] },
  };
  const chart = new uPlot(options, [plot.times, ...plot.series.map((s) => s.values)], place);
  new ResizeObserver(() => chart.setSize({ width: place.clientWidth, height })).observe(place);
}

/** Returns the section, and a function to call once it is in the page. */
export function plotSection(plots, pick) {
  const places = plots.map((plot) => element("div", { className: "plot" }, element("h3", {}, plot.title)));
  return {
    node: section("Over time", element("div", { className: "plots" }, ...places)),
    mount: () => plots.forEach((plot, i) => draw(plot, places[i], pick)),
  };
}
