// Erasing: whole strokes by a touch, or, with Alt or in the mode for parts, only what the eraser goes over. One drag is one step.

import type { Stroke } from "../../messages";
import { type Desk, here, pixels } from "../desk";
import { cut } from "../line/cutting";
import { distance } from "../line/nearness";
import { distanceToSpan } from "../line/thinning";
import { freshId, replace } from "../steps";
import { isScribble } from "../trunk/scribbles";
import type { Tool, Touch } from "./touch";

const REACH = 9; // CSS pixels
const STEP = 0.5; // of the eraser's radius: how far it is moved between two cuts

export function erasing(desk: Desk): Tool {
  let part = false;
  let last: Touch | null = null;

  const go = (at: Touch): void => {
    const radius = pixels(desk, REACH);
    const from = last ?? at;
    const steps = part ? Math.max(1, Math.ceil(Math.hypot(at.x - from.x, at.y - from.y) / (radius * STEP))) : 1;
    for (const stroke of here(desk.store)) {
      if (!part) {
        if (touched(stroke, from, at, radius)) desk.instead.set(stroke.id, []);
        continue;
      }
      for (let step = 1; step <= steps; step += 1) {
        const share = step / steps;
        cutAll(desk, stroke, from.x + share * (at.x - from.x), from.y + share * (at.y - from.y), radius);
      }
    }
    last = at;
    desk.eraser = { x: at.x, y: at.y, radius };
    desk.repaint();
  };
  const end = (): void => {
    desk.instead.clear();
    desk.eraser = null;
    last = null;
    desk.repaint();
  };
  return {
    cursor: "none",
    down: (at) => {
      part = at.alt || desk.erases === "part";
      go(at);
    },
    move: (fresh) => fresh.forEach(go),
    up: () => {
      const done = new Map(desk.instead);
      desk.instead.clear();
      replace(desk.store, "erase", done);
      end();
    },
    cancel: end,
    hover: (at) => {
      desk.eraser = at ? { x: at.x, y: at.y, radius: pixels(desk, REACH) } : null;
      desk.repaintLive();
    },
  };
}

function cutAll(desk: Desk, stroke: Stroke, x: number, y: number, radius: number): void {
  const before = desk.instead.get(stroke.id) ?? [stroke];
  if (!before.some((one) => distance(one, x, y) <= radius)) return;
  desk.instead.set(stroke.id, before.flatMap((one) => cut(one, x, y, radius, freshId, isRootAtEnd(desk, stroke))));
}

/** It was joined to its parent at its last point, not its first. */
function isRootAtEnd(desk: Desk, stroke: Stroke): boolean {
  const mark = desk.store.known.read?.marks.find((one) => one.stroke === stroke.id);
  if (!mark) return false;
  const { xy } = stroke;
  return Math.hypot(xy[xy.length - 2]! - mark.x, xy[xy.length - 1]! - mark.y) < Math.hypot(xy[0]! - mark.x, xy[1]! - mark.y);
}

/** The eraser passed over it on its way. */
function touched(stroke: Stroke, from: Touch, to: Touch, radius: number): boolean {
  const reach = isScribble(stroke) ? Math.max(radius, (stroke.width ?? 0) / 2) : radius; // a brush is as wide as it looks
  if (distance(stroke, to.x, to.y) <= reach) return true;
  for (let at = 0; at + 3 < stroke.xy.length; at += 2) {
    const [ax, ay, bx, by] = [stroke.xy[at]!, stroke.xy[at + 1]!, stroke.xy[at + 2]!, stroke.xy[at + 3]!];
    if (distanceToSpan({ x: ax, y: ay }, from, to) <= radius || crosses(ax, ay, bx, by, from, to)) return true;
  }
  return false;
}

function crosses(ax: number, ay: number, bx: number, by: number, from: Touch, to: Touch): boolean {
  const side = (x: number, y: number): number => (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
  const other = (x: number, y: number): number => (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  return side(ax, ay) * side(bx, by) < 0 && other(from.x, from.y) * other(to.x, to.y) < 0;
}
