// Moving the picture to trace over: by its inside, or larger and smaller by its lower right corner.

import type { Underlay } from "../../messages";
import { type Desk, pixels } from "../desk";
import type { Touch } from "./touch";

const CORNER = 16; // CSS pixels
const LEAST = 20; // CSS pixels wide

/** Take hold of it; null where it is not. */
export function moveUnderlay(desk: Desk, start: Touch): { to: (at: Touch) => void; done: () => void } | null {
  const held = desk.store.known.underlay;
  if (!held) return null;
  const [right, bottom] = [held.x + held.width, held.y + held.height];
  const corner = Math.hypot(start.x - right, start.y - bottom) < pixels(desk, CORNER);
  const inside = start.x >= held.x && start.x <= right && start.y >= held.y && start.y <= bottom;
  if (!corner && !inside) return null;
  return {
    to: (at) => { desk.underlay = corner ? sized(held, at, pixels(desk, LEAST)) : { ...held, x: held.x + at.x - start.x, y: held.y + at.y - start.y }; },
    done: () => {
      if (!desk.underlay) return;
      desk.store.known.underlay = desk.underlay; // until the program says so
      desk.store.send({ type: "setunderlay", underlay: desk.underlay });
    },
  };
}

function sized(held: Underlay, at: Touch, least: number): Underlay {
  const width = Math.max(least, at.x - held.x);
  return { ...held, width, height: (held.height * width) / held.width };
}
