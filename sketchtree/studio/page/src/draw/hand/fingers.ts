// How do fingers move the page? One shifts it; two shift it and bring it closer or farther, the places under them staying under them.

import type { PageCamera } from "../camera";

export class Fingers {
  private readonly places = new Map<number, [number, number]>();

  constructor(private readonly camera: PageCamera) {}

  get count(): number {
    return this.places.size;
  }

  down(finger: number, x: number, y: number): void {
    this.places.set(finger, [x, y]);
  }

  up(finger: number): void {
    this.places.delete(finger);
  }

  /** It is here now; the page goes along if `moves`. Whether it is one of ours. */
  move(finger: number, x: number, y: number, moves: boolean): boolean {
    const before = this.places.get(finger);
    if (!before) return false;
    const other = [...this.places].find(([id]) => id !== finger)?.[1];
    this.places.set(finger, [x, y]);
    if (!moves) return true;
    if (!other) {
      this.camera.pan(x - before[0], y - before[1]);
      return true;
    }
    const [wasX, wasY] = [(before[0] + other[0]) / 2, (before[1] + other[1]) / 2];
    const [nowX, nowY] = [(x + other[0]) / 2, (y + other[1]) / 2];
    const apart = Math.hypot(before[0] - other[0], before[1] - other[1]);
    this.camera.pan(nowX - wasX, nowY - wasY);
    if (apart > 1) this.camera.zoom(Math.hypot(x - other[0], y - other[1]) / apart, nowX, nowY);
    return true;
  }
}
