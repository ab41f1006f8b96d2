// How does the time of the growth go on? By itself while it plays, or by a hand on the slider.

import { SECONDS } from "./ageing";

const LONGEST = 0.25; // seconds that a frame may take: the program may have been asleep
const HOLDS = 1.5; // seconds at which it stands grown before it starts again

export class Clock {
  time = 1; // 0: a seed, 1: the tree
  playing = false;
  loops = false;
  private last: number | null = null;
  private held = 0;

  /** From the beginning where it is over. */
  play(): void {
    if (this.time >= 1) this.time = 0;
    this.playing = true;
    this.last = null;
    this.held = 0;
  }

  pause(): void {
    this.playing = false;
  }

  /** A hand is on it. */
  set(time: number): void {
    this.playing = false;
    this.time = Math.min(1, Math.max(0, time));
  }

  /** It is this late (milliseconds); does it go on? */
  tick(now: number): boolean {
    if (!this.playing) return false;
    const step = this.last === null ? 0 : Math.min(LONGEST, (now - this.last) / 1000);
    this.last = now;
    if (this.time < 1) this.time = Math.min(1, this.time + step / SECONDS);
    else if (!this.loops) this.playing = false;
    else if ((this.held += step) >= HOLDS) [this.time, this.held] = [0, 0];
    return this.playing;
  }
}
