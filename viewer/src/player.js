// SPDX-License-Identifier: Apache-2.0
//
// Goes through time: button, slider, keys, speed.
import { element, number } from "./dom.js";

const speeds = [0.1, 0.25, 0.5, 1, 2, 4];

export class Player {
  /** `shown(time)` is called whenever another time is to be seen. */
  constructor(motion, shown) {
    this.motion = motion;
    this.times = motion.times;
    this.shown = shown;
    this.time = motion.first;
    this.playing = false;
    this.rate = 1;
    this.button = element("button", { type: "button", className: "play", onclick: () => this.toggle() }, "Play");
    this.slider = element("input", {
      type: "range",
      min: motion.first,
      max: motion.last,
      step: "any",
      value: this.time,
      ariaLabel: "Time",
    });
    this.slider.oninput = () => this.stopAt(Number(this.slider.value));
    this.slider.onkeydown = (event) => this.key(event);
    this.label = element("output");
    this.speed = element(
      "select",
      { ariaLabel: "Speed" },
      ...speeds.map((s) => element("option", { value: s, selected: s === 1 }, `${s} ×`)),
    );
    this.speed.onchange = () => {
      this.rate = Number(this.speed.value);
    };
    addEventListener("keydown", (event) => {
      if (event.target === document.body) this.key(event);
    });
    this.say();
  }

  /** The last frame that is not later. */
  get frame() {
    return this.motion.frameAt(this.time);
  }

  key(event) {
    const { frame } = this,
      whole = this.time === this.times[frame];
    if (event.key === " ") this.toggle();
    else if (event.key === "ArrowRight") this.stopAt(this.times[Math.min(frame + 1, this.times.length - 1)]);
    else if (event.key === "ArrowLeft") this.stopAt(this.times[Math.max(whole ? frame - 1 : frame, 0)]);
    else return;
    event.preventDefault();
  }

  toggle() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return;
    if (this.time >= this.motion.last) this.show(this.motion.first);
    this.began = null;
    requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    if (!this.playing) return;
    if (this.began === null || this.began.rate !== this.rate) this.began = { now, time: this.time, rate: this.rate };
    const time = this.began.time + ((now - this.began.now) / 1000) * this.rate;
    this.show(Math.min(time, this.motion.last));
    if (time >= this.motion.last) this.toggle();
    else requestAnimationFrame((later) => this.tick(later));
  }

  stopAt(time) {
    if (this.playing) this.toggle();
    this.show(time);
  }

  go(frame) {
    this.show(this.times[Math.max(0, Math.min(this.times.length - 1, frame))]);
  }

  show(time) {
    this.time = Math.max(this.motion.first, Math.min(this.motion.last, time));
    this.slider.value = this.time;
    this.say();
    this.shown(this.time);
  }

  say() {
    this.label.textContent = this.motion.say(this.time, number);
    this.slider.ariaValueText = this.label.textContent;
  }
}
