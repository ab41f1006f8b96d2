// What lies on the drawing desk just now? What the pen is doing, before any of it is said to the program: painted by paint/, changed by hand/.

import type { Stroke, Underlay } from "../messages";
import type { Store } from "../store";
import type { PageCamera } from "./camera";
import type { Sample } from "./line/samples";
import type { Deed } from "./trunk/points";
import { isOfWay } from "./trunk/way";

export type Eraser = "whole" | "part";

export interface Live {
  kind: Stroke["kind"];
  line: Sample[]; // steady, with what the browser predicts at its end
  pressed: boolean; // its pressure is the pen's own
  width: number;
}

export interface Desk {
  store: Store;
  camera: PageCamera;
  live: Live | null; // the stroke in hand
  instead: Map<string, Stroke[]>; // what is shown in place of strokes: moved, pulled, cut, or nothing: erased
  hovered: string | null; // stroke under the pen
  lasso: number[]; // page units
  eraser: { x: number; y: number; radius: number } | null; // page units
  ring: { x: number; y: number; radius: number } | null; // of the brush, page units
  deed: Deed | null; // what the pen would do to the contour in a photo
  erases: Eraser;
  underlay: Underlay | null; // while it is being moved
  movesUnderlay: boolean;
  trouble: string | null; // stroke at fault
  letGo: () => void; // of what the tool in hand waits for
  tellDeed: (x: number, y: number) => void; // say it beside a pixel of the photo
  repaint: () => void; // everything
  repaintLive: () => void; // only what is in hand
}

/** Two azimuths are the same page. */
export function isSamePage(a: number, b: number): boolean {
  return Math.abs(((((a - b + 180) % 360) + 360) % 360) - 180) < 0.5;
}

/** An azimuth from -180 to 180. */
export function wrapped(degrees: number): number {
  const turned = ((((degrees + 180) % 360) + 360) % 360) - 180;
  return turned === -180 ? 180 : turned;
}

/** The strokes that are drawn on the page as it is turned now, and say something there: these can be changed here. */
export function here(store: Store): Stroke[] {
  return [...store.known.strokes.values()].filter((stroke) => isSamePage(stroke.view_deg, store.ui.turn) && isOfWay(store, stroke));
}

/** Page units that look as long as so many CSS pixels. */
export function pixels(desk: Desk, count: number): number {
  return count / desk.camera.scale;
}
