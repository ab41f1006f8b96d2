// With how many pixels is it drawn while it moves? With fewer when frames come late, with more when there is time. At rest with all of them.

const LATE = 34; // milliseconds a frame: slower than 30 a second
const EARLY = 20;
const LEAST = 0.4; // pixels a CSS pixel
const GAP = 400; // between frames: not one motion

export class Pace {
  private moving: number;
  private last = 0;
  private readonly times: number[] = [];

  constructor(readonly software: boolean) {
    this.moving = software ? 0.5 : 2;
  }

  ratio(moving: boolean, device: number): number {
    const sharp = Math.min(device, this.software ? 1 : 2);
    return moving ? Math.min(sharp, this.moving) : sharp;
  }

  /** A frame was drawn at this time. */
  drew(now: number, moving: boolean): void {
    const took = now - this.last;
    this.last = now;
    if (!moving || took > GAP) return;
    this.times.push(took);
    if (this.times.length < 6) return;
    const middle = this.times.sort((a, b) => a - b)[3]!;
    this.times.length = 0;
    if (middle > LATE) this.moving = Math.max(LEAST, this.moving * 0.75);
    else if (middle < EARLY) this.moving = Math.min(2, this.moving * 1.2);
  }
}
