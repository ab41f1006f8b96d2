// Moving the page under the pen.

import type { Desk } from "../desk";
import type { Tool, Touch } from "./touch";

export function panning(desk: Desk): Tool {
  let last: Touch | null = null;
  const to = (at: Touch): void => {
    if (last) desk.camera.pan(at.px - last.px, at.py - last.py);
    last = at;
  };
  const end = (): void => { last = null; };
  return {
    cursor: "grab",
    held: "grabbing",
    down: to,
    move: (fresh) => { if (fresh.length) to(fresh[fresh.length - 1]!); },
    up: end,
    cancel: end,
    hover: () => {},
  };
}
