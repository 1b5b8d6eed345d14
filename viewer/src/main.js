// SPDX-License-Identifier: Apache-2.0
//
// Puts the report together. Whatever it shows was computed before: nothing is decided here.
import * as data from "./data.js";
import { contactSection } from "./contacts.js";
import { element, list, section } from "./dom.js";
import { Player } from "./player.js";
import { plotSection } from "./plots.js";
import { describe } from "./results.js";
import { View } from "./view.js";

function head(page) {
  const { word, tone } = page.verdict;
  return element("header", {}, element("h1", {}, page.title),
    element("p", {}, element("span", { className: `badge ${tone}` }, word.replaceAll("_", " "))),
    ...page.verdict.lines.map((line) => element("p", {}, line)),
    page.facts.length > 0 ? list(page.facts) : null,
    element("p", { className: "soft" }, page.made));
}

function statement(page) {
  if (page.statement.length === 0) return null;
  return section("What is stated", list(page.statement));
}

/** In which step (from 1) the motion is at a time; both steps at a border. */
function stepsAt(ends, time) {
  const steps = [];
  let begin = ends.begin;
  ends.list.forEach((end, i) => {
    if (begin <= time && time <= end) steps.push(i + 1);
    begin = end;
  });
  return steps;
}

async function stageSection(page, report) {
  const scene = page.scene;
  const stage = element("div", { className: "stage" });
  const node = section("The motion");
  node.append(stage);
  const [cells, frames] = await Promise.all([data.cells(scene.cells), data.frames(scene)]);
  let view;
  try {
    view = new View(stage, scene, cells, frames);
  } catch (error) {
    stage.replaceWith(element("p", {}, "This browser draws no 3D (WebGL is missing or switched off)."));
    return { node, goToTime: () => {}, pick: () => {} };
  }
  let chosen = null;
  const mark = (frame) => {
    if (chosen) return view.mark(chosen.features);
    if (!page.contacts) return undefined;
    const steps = stepsAt(scene.steps, scene.times[frame]);
    return view.mark(page.contacts.listed.filter((c) => steps.includes(c.step)).flatMap((c) => c.features));
  };
  const player = new Player(scene.times, scene.unit, (frame) => {
    if (player.playing) chosen = null;
    view.positions.array.set(frames[frame]);
    view.positions.needsUpdate = true;
    mark(frame);
    if (!page.contacts) view.draw();
  });
  const edges = element("input", { type: "checkbox", checked: scene.cells.faces <= 20000 });
  edges.onchange = () => view.showEdges(edges.checked);
  view.showEdges(edges.checked);
  player.controls.append(element("label", {}, edges, " edges"));
  node.append(player.controls, element("p", { className: "soft" }, scene.note));
  mark(0);
  Object.assign(report, { view, player });
  return {
    node,
    goToTime: (time) => player.goToTime(time),
    pick: (contact) => {
      chosen = contact;
      player.goToTime(contact.step > 1 ? scene.steps.list[contact.step - 2] : scene.steps.begin);
    },
  };
}

async function build() {
  const report = {};
  const page = data.page();
  const place = document.getElementById("report");
  place.append(head(page));
  const stated = statement(page);
  if (stated) place.append(stated);
  let motion = null;
  if (page.scene) {
    motion = await stageSection(page, report);
    place.append(motion.node);
  }
  if (page.contacts) place.append(contactSection(page.contacts, (contact) => motion && motion.pick(contact)));
  if (page.plots.length > 0) {
    const plots = plotSection(page.plots, (time) => motion && motion.goToTime(time));
    place.append(plots.node);
    plots.mount();
  }
  for (const { name, image } of page.pictures) {
    place.append(section(name, element("img", { className: "picture", src: image, alt: name })));
  }
  for (const { name, result } of page.results) place.append(section(name, ...describe(result)));
  return report;
}

/** For whoever drives the page: resolves when all is there. */
window.noliReport = build();
window.noliReport.then(() => document.body.setAttribute("data-ready", "true"));
