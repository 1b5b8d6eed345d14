// SPDX-License-Identifier: Apache-2.0
//
// Marks on the time line: one bar for each step with contacts, as high as the logarithm of their number. Of very long
// runs some steps share a bar. A click takes the nearest bar; two buttons do the same from the keyboard.
import { counted, element, number } from "./dom.js";

const mostBars = 400;

/**
 * Bars {from, to, step, total}: `step` is the first of theirs that has contacts. Steps in `goesOn` have a bar, too:
 * contacts that were counted before go on there.
 */
function barsOf(perStep, goesOn, motion) {
  const together = Math.ceil(perStep.length / mostBars);
  const list = [];
  perStep.forEach((total, i) => {
    if (total === 0 && !goesOn.has(i + 1)) return;
    const bin = Math.floor(i / together);
    const [from, to] = motion.step(i + 1);
    const last = list[list.length - 1];
    if (last && last.bin === bin) Object.assign(last, { to, total: last.total + total });
    else list.push({ bin, from, to, step: i + 1, total });
  });
  return list;
}

function barNode({ from, to, step, total }, motion, most) {
  const part = (time) =>
    (100 * (Math.min(Math.max(time, motion.first), motion.last) - motion.first)) / (motion.last - motion.first || 1);
  const node = element("div", {
    className: "bar",
    title: `step ${number(step)}: ${total > 0 ? counted(total, "contact") : "contacts go on"}`,
  });
  node.style.left = `${part(from)}%`;
  node.style.width = `max(4px, ${part(to) - part(from)}% - 1px)`;
  node.style.height = `${100 * (0.25 + (0.75 * Math.log1p(total)) / Math.log1p(most))}%`;
  return node;
}

/** `firstTime`: of the first contact, or null; `pick(step)` is called for the step of a bar. */
export function markStrip(perStep, goesOn, motion, firstTime, pick) {
  const list = barsOf(perStep, goesOn, motion);
  const most = Math.max(1, ...list.map((bar) => bar.total));
  const strip = element("div", { className: "marks", role: "img" }, ...list.map((bar) => barNode(bar, motion, most)));
  strip.ariaLabel = `${counted(perStep.filter((n) => n > 0).length, "step has", "steps have")} contacts, the first is step ${number(list[0].step)}`;
  if (firstTime !== null) {
    const tick = element("div", { className: "tick", title: "first contact" });
    tick.style.left = `${(100 * (firstTime - motion.first)) / (motion.last - motion.first || 1)}%`;
    strip.append(tick);
  }
  strip.onclick = (event) => {
    const box = strip.getBoundingClientRect();
    const time = motion.first + ((event.clientX - box.left) / box.width) * (motion.last - motion.first);
    const away = (bar) => Math.max(bar.from - time, time - bar.to, 0);
    pick(list.reduce((best, bar) => (away(bar) < away(best) ? bar : best)).step);
  };
  return strip;
}

/** Buttons to the step with contacts before and after the one that is seen: `step()` says which that is. */
export function stepButtons(perStep, step, pick) {
  const go = (from, by) => {
    for (let i = from + by; i >= 1 && i <= perStep.length; i += by) {
      if (perStep[i - 1] > 0) return pick(i);
    }
    return undefined;
  };
  const button = (text, ariaLabel, by) =>
    element("button", { type: "button", ariaLabel, title: ariaLabel, onclick: () => go(step(), by) }, text);
  return [button("◂", "Previous step with contacts", -1), button("▸", "Next step with contacts", 1)];
}
