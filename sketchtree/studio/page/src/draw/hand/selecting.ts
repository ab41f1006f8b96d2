// Selecting: a click takes a stroke, or on a turned page the limb seen there; a drag over nothing is a lasso; a drag on what is chosen pulls it into another
// shape, or moves it: with Alt, several at once, or an area by its inside.

import type { Stroke } from "../../messages";
import { type Desk, here, isSamePage, pixels } from "../desk";
import { distance, isCaught, isInside, nearest, nearestPoint } from "../line/nearness";
import { moved, pulled } from "../line/reshaping";
import { distanceToSpan } from "../line/thinning";
import { limbOf } from "../selection";
import { replace } from "../steps";
import { projected } from "../turned";
import type { Tool, Touch } from "./touch";
import { moveUnderlay } from "./underlay";

const REACH = 10; // CSS pixels
const STILL = 3; // CSS pixels: a drag that goes no farther is a click
const PULL = 0.35; // of the line's length, to both sides of where it is held

type Grip = { at: Touch; strokes: Stroke[]; pull: { stroke: Stroke; point: number } | null };

export function selecting(desk: Desk): Tool {
  let grip: Grip | null = null;
  let start: Touch | null = null;
  let underlay: ReturnType<typeof moveUnderlay> = null;
  let far = false;

  const end = (): void => {
    grip = start = underlay = null;
    far = false;
    desk.lasso = [];
    desk.instead.clear();
    desk.underlay = null;
    desk.repaint();
  };
  return {
    get cursor() { return far && grip ? "grabbing" : desk.hovered === null ? "default" : "pointer"; },
    down: (at) => {
      start = at;
      underlay = desk.movesUnderlay ? moveUnderlay(desk, at) : null;
      grip = underlay ? null : take(desk, at);
    },
    move: (fresh) => {
      const at = fresh[fresh.length - 1];
      if (!at || !start) return;
      far ||= Math.hypot(at.px - start.px, at.py - start.py) > STILL;
      if (!far) return;
      if (underlay) underlay.to(at);
      else if (grip) drag(desk, grip, at);
      else desk.lasso.push(...fresh.flatMap((one) => [one.x, one.y]));
      desk.repaint();
    },
    up: (at) => {
      if (underlay) underlay.done();
      else if (far && grip) {
        const done = new Map(desk.instead);
        desk.instead.clear();
        replace(desk.store, grip.pull ? "reshape" : "move", done);
      } else if (far) lasso(desk, at);
      else if (!grip) click(desk, at);
      end();
    },
    cancel: end,
    hover: (at) => {
      const over = at ? (under(desk, at)?.id ?? null) : null;
      if (over === desk.hovered) return;
      desk.hovered = over;
      desk.store.set("pointed", over === null ? null : (limbOf(desk.store, over)?.id ?? null));
      desk.repaint();
    },
  };
}

/** The stroke under the pen: its line, or the inside of an area. */
function under(desk: Desk, at: Touch): Stroke | null {
  const strokes = here(desk.store);
  const reach = pixels(desk, REACH);
  const lines = nearest(strokes, at.x, at.y, reach);
  if (lines) return lines;
  const chosen = new Set(desk.store.ui.selectedStrokes);
  return strokes.find((stroke) => chosen.has(stroke.id) && stroke.closed && isInside(stroke.xy, at.x, at.y)) ?? null;
}

/** Choose what is under the pen and hold it; null: nothing is there. */
function take(desk: Desk, at: Touch): Grip | null {
  const found = under(desk, at);
  if (!found) return null;
  const { store } = desk;
  const chosen = store.ui.selectedStrokes;
  if (at.shift) store.set("selectedStrokes", chosen.includes(found.id) ? chosen.filter((id) => id !== found.id) : [...chosen, found.id]);
  else if (!chosen.includes(found.id)) store.set("selectedStrokes", [found.id]);
  const strokes = store.ui.selectedStrokes.flatMap((id) => store.known.strokes.get(id) ?? []).filter((stroke) => isSamePage(stroke.view_deg, store.ui.turn));
  const onLine = distance(found, at.x, at.y) <= pixels(desk, REACH);
  const pulls = strokes.length === 1 && onLine && !at.alt;
  return { at, strokes, pull: pulls ? { stroke: found, point: nearestPoint(found, at.x, at.y) } : null };
}

function drag(desk: Desk, grip: Grip, at: Touch): void {
  const [dx, dy] = [at.x - grip.at.x, at.y - grip.at.y];
  if (grip.pull) {
    const { stroke, point } = grip.pull;
    desk.instead.set(stroke.id, [pulled(stroke, point, dx, dy, PULL * Math.max(lengthOf(stroke), pixels(desk, REACH)))]);
  } else for (const stroke of grip.strokes) desk.instead.set(stroke.id, [moved(stroke, dx, dy)]);
}

function lengthOf({ xy }: Stroke): number {
  let sum = 0;
  for (let at = 2; at < xy.length; at += 2) sum += Math.hypot(xy[at]! - xy[at - 2]!, xy[at + 1]! - xy[at - 1]!);
  return sum;
}

function lasso(desk: Desk, at: Touch): void {
  const caught = here(desk.store).filter((stroke) => isCaught(stroke, desk.lasso)).map((stroke) => stroke.id);
  const before = at.shift ? desk.store.ui.selectedStrokes : [];
  desk.store.set("selectedStrokes", [...new Set([...before, ...caught])]);
}

/** Nothing of this page is there; perhaps a limb of another. */
function click(desk: Desk, at: Touch): void {
  const { store } = desk;
  const { tree, limbs } = store.known;
  let found: string | null = null;
  let least = pixels(desk, REACH);
  for (const limb of tree ? limbs : []) {
    const xy = projected(limb, tree!, store.ui.turn);
    for (let point = 0; point + 3 < xy.length; point += 2) {
      const away = distanceToSpan(at, { x: xy[point]!, y: xy[point + 1]! }, { x: xy[point + 2]!, y: xy[point + 3]! });
      if (away < least) [found, least] = [limb.id, away];
    }
  }
  if (found === null) store.set("selectedStrokes", []);
  store.set("selected", found);
}
