// SPDX-License-Identifier: Apache-2.0
//
// The motion with its contacts: view, time line and list, which follow each other. It opens at the first contact.
import { contactList } from "./contacts.js";
import * as data from "./data.js";
import { counted, element, number } from "./dom.js";
import { contactText, inOrder, intersectionsOf } from "./features.js";
import { markStrip, stepButtons } from "./marks.js";
import { Motion } from "./motion.js";
import { Player } from "./player.js";
import { View } from "./view.js";

const mostListed = 1000;
const mostWithEdges = 20000; // faces: of more, edges are drawn when they are asked for

/** Contacts of each step; where the page does not say, those that are listed. */
export function contactsPerStep(contacts, steps) {
  if (!contacts || contacts.total + contacts.initial === 0) return [];
  if (contacts.per_step && contacts.per_step.length > 0) return contacts.per_step;
  const counts = new Array(steps).fill(0);
  for (const { step } of contacts.listed) if (step <= steps) ++counts[step - 1];
  return counts;
}

/** Contacts by their step. */
function grouped(list) {
  const groups = new Map();
  for (const contact of list) {
    if (!groups.has(contact.step)) groups.set(contact.step, []);
    groups.get(contact.step).push(contact);
  }
  return groups;
}

class Stage {
  constructor(page, cells, frames) {
    this.page = page;
    this.scene = page.scene;
    this.motion = new Motion(page.scene, frames);
    this.inStep = page.scene.unit !== "s";
    this.list = page.contacts
      ? [...inOrder(page.contacts, mostListed), ...intersectionsOf(page.contacts, cells)].slice(0, mostListed)
      : [];
    this.byStep = grouped(this.list);
    this.perStep = contactsPerStep(page.contacts, page.scene.steps.list.length);
    this.place = element("div", {
      className: "stage",
      ariaLabel: "The mesh; drag to turn, scroll or pinch to zoom",
      role: "img",
    });
    this.caption = element("p", { className: "caption", role: "status" });
    this.view = new View(this.place, page.scene, cells);
    this.player = new Player(this.motion, (time) => this.show(time));
    this.makeNode();
  }

  makeNode() {
    const left = element(
      "div",
      { className: "seen" },
      this.place,
      this.caption,
      this.timeLine(),
      this.controls(),
      element("p", { className: "soft" }, this.scene.note),
    );
    this.node = element("section", { className: "motion" }, element("h2", { className: "unseen" }, "The motion"), left);
    this.place.append(this.cameraButtons());
    if (!this.page.contacts || this.page.contacts.total + this.page.contacts.initial === 0) return;
    this.contacts = contactList(this.page.contacts, this.list, this.scene.parts, this.inStep, (contact) =>
      this.pick(contact),
    );
    this.node.append(this.contacts.node);
    this.node.classList.add("two");
  }

  cameraButtons() {
    const button = (text, onclick) => element("button", { type: "button", onclick }, text);
    this.toContact = button("Contact", () => {
      this.chosen && this.pick(this.chosen);
    });
    return element(
      "div",
      { className: "camera" },
      this.toContact,
      button("Whole scene", () => this.view.showAll()),
    );
  }

  timeLine() {
    const line = element("div", { className: "timeline" });
    const first = this.list.length > 0 && this.list[0].time !== undefined ? this.motion.timeOf(this.list[0]) : null;
    if (this.perStep.some((n) => n > 0)) {
      const goesOn = new Set(this.page.contacts.goes_on ?? []);
      line.append(markStrip(this.perStep, goesOn, this.motion, first, (step) => this.pickStep(step)));
    }
    line.append(this.player.slider);
    return line;
  }

  controls() {
    const { player, view, scene } = this;
    const edges = element("input", { type: "checkbox", checked: scene.cells.faces <= mostWithEdges });
    edges.onchange = () => view.showEdges(edges.checked);
    view.showEdges(edges.checked);
    const steps =
      this.perStep.filter((n) => n > 0).length > 1
        ? stepButtons(
            this.perStep,
            () => this.motion.stepAt(player.time),
            (step) => this.pickStep(step),
          )
        : [];
    return element(
      "div",
      { className: "controls" },
      player.button,
      ...steps,
      player.label,
      player.speed,
      element("label", {}, edges, " edges"),
      ...this.givenControl(),
    );
  }

  /** Shows and hides the motion that this one was made from. */
  givenControl() {
    const part = this.scene.parts.find((p) => p.given);
    if (!part) return [];
    const box = element("input", { type: "checkbox", checked: true });
    box.onchange = () => this.view.showGiven(box.checked);
    return [element("label", {}, box, ` ${part.name}`)];
  }

  show(time) {
    this.view.move((array) => this.motion.write(time, array));
    this.showOthers(this.motion.stepAt(time));
  }

  /** The other listed contacts of a step. */
  showOthers(step) {
    if (this.shownStep === step) return;
    this.shownStep = step;
    this.view.showOthers((this.byStep.get(step) ?? []).filter((c) => c !== this.chosen));
  }

  say(text, legend) {
    const keys = legend
      ? [element("span", { className: "key first" }), element("span", { className: "key second" }), " "]
      : [];
    this.caption.replaceChildren(...keys, text);
  }

  /** Goes to a contact, and turns the camera to it. */
  pick(contact) {
    this.chosen = contact;
    this.shownStep = null;
    this.view.choose(contact);
    this.player.stopAt(this.motion.timeOf(contact));
    const cut = this.view.frame(contact) ? " The view is cut open: what hides the contact is left out." : "";
    this.say((contact.words ?? `${contactText(contact, this.scene.parts, this.inStep)}.`) + cut, true);
    this.toContact.hidden = false;
    if (this.contacts) this.contacts.choose(contact);
    this.scrollTo();
  }

  /** A mark stands for a step: its first listed contact, or, where none is listed, the step. */
  pickStep(step) {
    const [contact] = this.byStep.get(step) ?? [];
    if (contact) return this.pick(contact);
    this.chosen = null;
    this.view.choose(null);
    this.player.stopAt(this.motion.step(step)[0]);
    const total = this.perStep[step - 1];
    return this.say(
      total > 0
        ? `Step ${number(step)} has ${counted(total, "contact")}, which this page does not list.`
        : `No contact begins in step ${number(step)}.`,
      false,
    );
  }

  /** So that a click on a contact below the view shows it on a small screen. */
  scrollTo() {
    if (!this.opened) return;
    const box = this.place.getBoundingClientRect();
    if (box.top < 0 || box.bottom > innerHeight) this.place.scrollIntoView({ block: "start", behavior: "smooth" });
  }

  /** Once it is in the page. Resolves when it has been drawn. */
  open() {
    this.view.resize();
    const first = this.list[0] ?? this.page.focus;
    this.toContact.textContent = first?.name ?? (first?.meets === false ? "Nearest pair" : "Contact");
    this.toContact.hidden = !first;
    if (first) this.pick(first);
    else this.player.show(this.motion.first);
    // Two motions over each other say most as a whole.
    if (this.view.given) this.view.showAll();
    this.opened = true;
    return this.view.changed();
  }
}

/** Returns {node, goToTime(time)}, and puts view and player into `report`, for whoever drives the page. */
export async function stageSection(page, report) {
  const [cells, frames] = await Promise.all([data.cells(page.scene.cells), data.frames(page.scene)]);
  try {
    const stage = new Stage(page, cells, frames);
    Object.assign(report, { view: stage.view, player: stage.player, stage });
    return { node: stage.node, goToTime: (time) => stage.player.stopAt(time), open: () => stage.open() };
  } catch (error) {
    console.info(error);
    const node = element(
      "section",
      {},
      element("h2", {}, "The motion"),
      element("p", {}, "This browser draws no 3D: WebGL is missing or switched off."),
    );
    if (page.contacts) {
      const list = inOrder(page.contacts, mostListed);
      node.append(contactList(page.contacts, list, page.scene.parts, page.scene.unit !== "s", () => {}).node);
    }
    return { node, goToTime: () => {}, open: () => {} };
  }
}
