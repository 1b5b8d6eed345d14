// SPDX-License-Identifier: Apache-2.0
//
// Goes through the frames: button, slider, keys, speed.
import { element, number } from "./dom.js";

const speeds = [0.1, 0.25, 0.5, 1, 2, 4];

export class Player {
  /** `times`: of the frames, ascending; `shown(frame)` is called whenever another frame is to be seen. */
  constructor(times, unit, shown) {
    this.times = times;
    this.unit = unit;
    this.shown = shown;
    this.frame = 0;
    this.playing = false;
    this.rate = 1;
    this.button = element("button", { type: "button", onclick: () => this.toggle() }, "Play");
    this.slider = element("input", { type: "range", min: 0, max: times.length - 1, value: 0, ariaLabel: "Time" });
    this.slider.oninput = () => this.stopAt(Number(this.slider.value));
    this.label = element("output");
    const speed = element("select", { ariaLabel: "Speed" }, ...speeds.map((s) => element("option", { value: s, selected: s === 1 }, `${s} ×`)));
    speed.onchange = () => { this.rate = Number(speed.value); };
    this.controls = element("div", { className: "controls" }, this.button, this.slider, this.label, speed);
    addEventListener("keydown", (event) => this.key(event));
    this.say();
  }

  key(event) {
    if (event.target !== document.body) return;
    const steps = { ArrowLeft: -1, ArrowRight: 1 };
    if (event.key === " ") this.toggle();
    else if (event.key in steps) this.stopAt(this.frame + steps[event.key]);
    else return;
    event.preventDefault();
  }

  toggle() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return;
    if (this.frame === this.times.length - 1) this.go(0);
    this.began = null;
    requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    if (!this.playing) return;
    if (this.began === null || this.began.rate !== this.rate) this.began = { now, time: this.times[this.frame], rate: this.rate };
    const time = this.began.time + ((now - this.began.now) / 1000) * this.rate;
    let next = this.frame;
    while (next + 1 < this.times.length && this.times[next + 1] <= time) ++next;
    if (next !== this.frame) this.go(next);
    if (next + 1 === this.times.length) this.toggle();
    else requestAnimationFrame((later) => this.tick(later));
  }

  stopAt(frame) {
    if (this.playing) this.toggle();
    this.go(frame);
  }

  /** The last frame that is not behind this time. */
  goToTime(time) {
    let frame = 0;
    while (frame + 1 < this.times.length && this.times[frame + 1] <= time) ++frame;
    this.stopAt(frame);
  }

  go(frame) {
    this.frame = Math.max(0, Math.min(this.times.length - 1, frame));
    this.slider.value = this.frame;
    this.say();
    this.shown(this.frame);
  }

  say() {
    this.label.textContent = `${number(this.times[this.frame])} ${this.unit} (frame ${this.frame + 1} of ${this.times.length})`;
  }
}
