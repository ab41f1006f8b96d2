// Turning the page about the tree with the right button: a hand's width is a quarter turn; the front and the sides hold it a little.

import { type Desk, wrapped } from "../desk";
import type { Tool } from "./touch";

const PER_PIXEL = 0.4; // degrees
const QUARTER = 90;
const HOLD = 4; // degrees

export function turning(desk: Desk): Tool {
  let from = 0;
  let start = 0;
  const end = (): void => {};
  return {
    cursor: "ew-resize",
    down: (at) => {
      from = at.px;
      start = desk.store.ui.turn;
    },
    move: (fresh) => {
      const at = fresh[fresh.length - 1];
      if (!at) return;
      const degrees = Math.round(start - PER_PIXEL * (at.px - from));
      const quarter = Math.round(degrees / QUARTER) * QUARTER;
      desk.store.set("turn", wrapped(Math.abs(degrees - quarter) < HOLD ? quarter : degrees));
    },
    up: end,
    cancel: () => desk.store.set("turn", start),
    hover: end,
  };
}
