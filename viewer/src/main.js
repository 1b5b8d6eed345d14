// SPDX-License-Identifier: Apache-2.0
//
// Puts the report together. Whatever it shows was computed before: nothing is decided here.
import * as data from "./data.js";
import { contactList } from "./contacts.js";
import { element, section } from "./dom.js";
import { inOrder } from "./features.js";
import { facts, head, inSteps, statement } from "./head.js";
import { contactBars, drawPlots, plotSection } from "./plots.js";
import { resultSection } from "./results.js";
import { contactsPerStep, stageSection } from "./stage.js";

/** A verdict without its motion. */
function contactsAlone(page) {
  return element(
    "section",
    {},
    contactList(page.contacts, inOrder(page.contacts, 1000), [], inSteps(page), () => {}).node,
  );
}

function barsOf(page, report) {
  const perStep = contactsPerStep(page.contacts, page.scene ? page.scene.steps.list.length : 0);
  if (perStep.length < 2) return null;
  return contactBars(
    perStep,
    inSteps(page) ? "step" : "window",
    (step) => report.stage && report.stage.pickStep(Math.min(step, perStep.length)),
  );
}

function picture({ name, image }) {
  return section(name, element("img", { className: "picture", src: image, alt: `The picture ${name}` }));
}

async function build() {
  const report = {};
  const page = data.page();
  const place = document.getElementById("report");
  const put = (node) => {
    if (node) place.append(node);
  };
  put(head(page));
  const motion = page.scene ? await stageSection(page, report) : null;
  if (motion) {
    put(motion.node);
  } else if (page.contacts) {
    put(contactsAlone(page));
  }
  put(barsOf(page, report));
  page.results.forEach((result) => put(resultSection(result)));
  if (page.plots.length > 0) put(plotSection(page.plots, (time) => motion && motion.goToTime(time)));
  page.pictures.forEach((one) => put(picture(one)));
  put(statement(page));
  put(facts(page));
  drawPlots();
  if (motion) await motion.open();
  return report;
}

/** For whoever drives the page: resolves when all is there. */
window.noliReport = build();
window.noliReport.then(() => document.body.setAttribute("data-ready", "true"));
