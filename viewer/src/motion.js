// SPDX-License-Identifier: Apache-2.0
//
// Where vertices are at a time. Frames of `noli verify` are joined by straight lines, because that is the motion that
// was verified; of a run, or of frames at rest, the last frame that is not later stands.

export class Motion {
  constructor(scene, frames) {
    this.scene = scene;
    this.frames = frames;
    this.times = scene.times;
    this.moves = scene.unit === "steps";
  }

  get first() {
    return this.times[0];
  }
  get last() {
    return this.times[this.times.length - 1];
  }

  /** The last frame that is not later than this time. */
  frameAt(time) {
    let low = 0,
      high = this.times.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  /** Writes x y z of all vertices, in 65,535ths of the box. */
  write(time, out) {
    const frame = this.frameAt(time);
    const from = this.frames[frame],
      to = this.frames[frame + 1];
    const share = to && this.moves ? (time - this.times[frame]) / (this.times[frame + 1] - this.times[frame]) : 0;
    if (share <= 0) {
      out.set(from);
      return;
    }
    for (let i = 0; i < out.length; ++i) out[i] = Math.round(from[i] + share * (to[i] - from[i]));
  }

  /** Begin and end of a step, from 1. */
  step(step) {
    const { begin, list } = this.scene.steps;
    return [step > 1 ? list[step - 2] : begin, list[step - 1]];
  }

  /** In which step a time is; at a border the step that ends there. */
  stepAt(time) {
    const ends = this.scene.steps.list;
    let low = 0,
      high = ends.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (ends[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low + 1;
  }

  /** When a contact is, on the time line; the beginning of its step where it has no time. */
  timeOf({ step, time }) {
    if (step === undefined || this.scene.unit === "s") return time ?? this.step(step)[0];
    const [begin, end] = this.step(step);
    if (!this.moves) return (begin + end) / 2;
    return begin + (time ?? 0) * (end - begin);
  }

  /** "step 1 of 5, t = 0.25", "frame 2 of 6", "0.2 s". */
  say(time, number) {
    const frame = this.frameAt(time);
    const frames = `frame ${number(frame + 1)} of ${number(this.times.length)}`;
    if (this.scene.unit === "s") return `${number(time)} s, ${frames}`;
    if (!this.moves || time === this.times[frame]) return frames;
    const step = this.stepAt(time),
      [begin, end] = this.step(step);
    return `step ${number(step)} of ${number(this.scene.steps.list.length)}, t = ${number((time - begin) / (end - begin), 4)}`;
  }
}
