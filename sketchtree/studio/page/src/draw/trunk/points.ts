// The contour's vertices by hand (Algorithm 1, lines 9-10): a click on one removes it, a click on the contour makes one there, a drag along it, or two clicks with Shift, removes all between. What would
// happen is shown before it does.

import { byHand } from "../photo";
import { type Desk, pixels } from "../desk";
import type { Tool, Touch } from "../hand/touch";
import { type Contour, contourOf, type Corner, cornersBetween, gridOf, nearestCorner, nearestPlace, type Place, toPixels } from "./contour";
import { isClear, keeps, merged, MOST_EDITS, count, restored, shown, withPlace, without, type Edits, type Point } from "./edits";
import { isScribbled } from "./way";

const REACH = 11; // CSS pixels
const REACH_BY_HAND = 20;
const STILL = 4; // CSS pixels: a drag that goes no farther is a click

/** What a press would do here. */
export type Deed =
  | { what: "remove"; corner: Corner; why: string | null } // why: it can't be done
  | { what: "add"; place: Place }
  | { what: "restore"; point: Point }
  | { what: "merge"; from: Place; to: Place; gone: Corner[]; why: string | null };

interface Here {
  contour: Contour;
  corners: Corner[];
  edits: Edits;
}

let last: Here | null = null; // as it was asked for last

/** The contour as it is to be; null: there is none. */
export function pointsHere({ known }: Desk["store"]): Here | null {
  if (!known.found || !known.trunk || !isScribbled({ known })) return null;
  const contour = contourOf(known.found);
  if (last?.contour !== contour || last.edits !== known.trunk) last = { contour, corners: shown(contour, known.trunk), edits: known.trunk };
  return last;
}

export function points(desk: Desk): Tool {
  let start: Touch | null = null;
  let from: Place | null = null; // where a drag began, or the first click with Shift was
  let far = false;
  let waits = false; // for the second click with Shift

  const show = (deed: Deed | null): void => {
    desk.deed = deed;
    desk.repaintLive();
  };
  const over = (at: Touch): Deed | null => (waits && from ? spanTo(desk, from, at) : deedAt(desk, at));
  const end = (): void => {
    start = null;
    far = false;
    if (!waits) from = null;
    show(null);
  };
  return {
    get cursor() { return desk.deed && !why(desk.deed) ? "pointer" : "default"; },
    down: (at) => {
      start = at;
      if (!waits) from = placeAt(desk, at);
      show(over(at));
    },
    move: (fresh) => {
      const at = fresh[fresh.length - 1];
      if (!at || !start) return;
      far ||= Math.hypot(at.px - start.px, at.py - start.py) > STILL;
      if (far) show(from ? spanTo(desk, from, at) : null);
    },
    up: (at) => {
      const first = !far && at.shift && !waits;
      const deed = far || waits ? (from ? spanTo(desk, from, at) : null) : first ? null : deedAt(desk, at);
      waits = first && from !== null;
      if (deed) act(desk, deed);
      end();
      if (waits && from) show({ what: "merge", from, to: from, gone: [], why: null });
    },
    cancel: () => {
      waits = false;
      end();
    },
    hover: (at) => {
      if (at === null && !waits) from = null;
      show(at ? over(at) : null);
    },
  };
}

export function why(deed: Deed): string | null {
  return deed.what === "remove" || deed.what === "merge" ? deed.why : null;
}

/** In words, beside the pointer. */
export function said(deed: Deed): string {
  const not = why(deed);
  if (not !== null) return not;
  switch (deed.what) {
    case "remove": return "Remove this point";
    case "add": return "Add a point";
    case "restore": return "Bring it back";
    case "merge": return deed.gone.length ? `Merge: ${deed.gone.length === 1 ? "1 point goes" : `${deed.gone.length} points go`}` : "Now the other end";
  }
}

/** Do it, unless it can't be done. */
export function act({ store }: Desk, deed: Deed): void {
  const here = pointsHere(store);
  if (!here || why(deed) !== null || (deed.what === "merge" && !deed.gone.length)) return;
  const { contour, corners, edits } = here;
  const next = deed.what === "remove" ? without(edits, deed.corner) : deed.what === "add" ? withPlace(edits, deed.place)
    : deed.what === "restore" ? restored(edits, deed.point) : merged(contour, corners, deed.gone, edits);
  if (count(next) > MOST_EDITS) return;
  const { remove, add, merge } = next;
  store.chooseTrunk({ remove, add, merge }, `${deed.what} point ${count(next)}`); // a step each, however quickly they come
}

interface Aim extends Here {
  x: number; // pixels of the photo
  y: number;
  reach: number;
}

/** Where the pen is, on the contour's own grid; null: there is no contour. */
function aim(desk: Desk, at: Touch): Aim | null {
  const { underlay, found } = desk.store.known;
  const here = pointsHere(desk.store);
  if (!here || !underlay || !found) return null;
  const grid = gridOf(found, underlay);
  const [x, y] = toPixels(grid, at.x, at.y);
  return { ...here, x, y, reach: pixels(desk, byHand() ? REACH_BY_HAND : REACH) / grid.unit };
}

function placeAt(desk: Desk, at: Touch): Place | null {
  const to = aim(desk, at);
  return to && (nearestCorner(to.corners, to.x, to.y, to.reach) ?? nearestPlace(to.contour, to.x, to.y, to.reach));
}

function deedAt(desk: Desk, at: Touch): Deed | null {
  const to = aim(desk, at);
  if (!to) return null;
  const { contour, corners, edits, x, y, reach } = to;
  const corner = nearestCorner(corners, x, y, reach);
  if (corner) return { what: "remove", corner, why: keeps(corners, [corner]) };
  const gone = nearestCorner(edits.remove.map((point) => ({ x: point[0], y: point[1], point })), x, y, reach);
  if (gone) return { what: "restore", point: gone.point };
  const place = nearestPlace(contour, x, y, reach);
  return place && { what: "add", place };
}

/** What lies from a place to where the pen is now, wherever that is: the nearest place of the contour counts. */
function spanTo(desk: Desk, from: Place, at: Touch): Deed | null {
  const to = aim(desk, at);
  const end = to && (nearestCorner(to.corners, to.x, to.y, to.reach) ?? nearestPlace(to.contour, to.x, to.y));
  if (!to || !end) return null;
  if (from.ring !== end.ring) return { what: "merge", from, to: end, gone: [], why: "On one contour only" };
  const gone = cornersBetween(to.contour, to.corners, from, end);
  return { what: "merge", from, to: end, gone, why: !isClear(to.contour, from, end) ? "Too far round" : gone.length ? keeps(to.corners, gone) : "No point between" };
}
