// Where does the trunk stand? A click on it says so.

import type { Desk } from "../desk";
import type { Tool } from "../hand/touch";
import { gridOf, toPixels } from "./contour";

export function standing(desk: Desk): Tool {
  return {
    cursor: "crosshair",
    down: () => {},
    move: () => {},
    up: (at) => {
      const { found, underlay } = desk.store.known;
      if (!found || !underlay) return;
      const [x, y] = toPixels(gridOf(found, underlay), at.x, at.y).map((value) => Math.round(100 * value) / 100);
      if (x! >= 0 && y! >= 0 && x! <= found.size[0]! && y! <= found.size[1]!) desk.store.chooseTrunk({ root: [x!, y!] }, "foot");
    },
    cancel: () => {},
    hover: () => {},
  };
}
