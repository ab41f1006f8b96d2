// How does the eye get from here to there? In a short, soft flight; after a flick it goes on turning and slows down. One of them at a time.

import { between, turned, type Eye } from "./eye";

const FLIGHT = 360; // milliseconds
const SLOWING = 4; // a second: e-fold
const DEGREES = 0.32; // of turn, a pixel

export class Flight {
  private ticking: ((now: number) => Eye | null) | null = null;

  get moving(): boolean {
    return this.ticking !== null;
  }

  stop(): void {
    this.ticking = null;
  }

  /** Fly to another eye; at once for people who want no motion. */
  to(from: Eye, to: Eye, now: number): void {
    const time = matchMedia("(prefers-reduced-motion: reduce)").matches ? 1 : FLIGHT;
    this.ticking = (at) => {
      const share = Math.min(1, (at - now) / time);
      if (share >= 1) this.ticking = null;
      return between(from, to, share * share * (3 - 2 * share));
    };
  }

  /** Go on turning, from so many pixels a second. */
  fling(eye: Eye, right: number, down: number, now: number): void {
    if (Math.hypot(right, down) < 60 || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    let [seen, last] = [eye, now];
    this.ticking = (at) => {
      const slow = Math.exp((-SLOWING * (at - now)) / 1000);
      const step = (slow * Math.min(50, at - last)) / 1000;
      last = at;
      if (slow < 0.03) this.ticking = null;
      seen = byHand(seen, right * step, down * step);
      return seen;
    };
  }

  /** Where the eye is now; null: nothing moves it. */
  tick(now: number): Eye | null {
    return this.ticking?.(now) ?? null;
  }
}

/** The eye after a hand dragged so many pixels. */
export function byHand(eye: Eye, right: number, down: number): Eye {
  return turned(eye, -right * DEGREES, down * DEGREES);
}
