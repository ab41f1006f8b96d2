// The contour's vertices without a pointer: one after the other along the contour; what a press would do is said aloud.

import type { Desk } from "../desk";
import { ahead, type Corner, gridOf, pointAt } from "./contour";
import { keeps } from "./edits";
import { act, pointsHere } from "./points";

const EDGE = 90; // CSS pixels at the page's edges over which things may stand

/** In the order of their rings. */
function ordered(corners: readonly Corner[]): Corner[] {
  return [...corners].sort((a, b) => a.ring - b.ring || a.s - b.s);
}

function now(desk: Desk, corners: readonly Corner[]): number {
  const held = desk.deed?.what === "remove" ? desk.deed.corner : null;
  return held ? corners.findIndex((corner) => corner.ring === held.ring && corner.x === held.x && corner.y === held.y) : -1;
}

function screen({ store, camera }: Desk, x: number, y: number): [number, number] {
  const { found, underlay } = store.known;
  const grid = gridOf(found!, underlay!);
  return camera.toScreen(grid.left + x * grid.unit, grid.top + y * grid.unit);
}

/** The one nearest to the middle of what is seen. */
function inMiddle(desk: Desk, corners: readonly Corner[]): Corner {
  const away = (corner: Corner): number => {
    const [x, y] = screen(desk, corner.x, corner.y);
    return Math.hypot(x - desk.camera.width / 2, y - desk.camera.height / 2);
  };
  return corners.reduce((best, corner) => (away(corner) < away(best) ? corner : best));
}

/** The page moves so far that it is seen. */
function bringIn(desk: Desk, corner: Corner): void {
  const { camera } = desk;
  const [x, y] = screen(desk, corner.x, corner.y);
  const into = (at: number, long: number): number => Math.min(long - EDGE, Math.max(EDGE, at)) - at;
  const [dx, dy] = [into(x, camera.width), into(y, camera.height)];
  if (dx !== 0 || dy !== 0) camera.pan(dx, dy);
}

/** The next vertex is held, or the one before. */
export function nextPoint(desk: Desk, by: 1 | -1): void {
  const here = desk.store.ui.tool === "vertices" ? pointsHere(desk.store) : null;
  if (!here?.corners.length) return;
  const corners = ordered(here.corners);
  const at = now(desk, corners);
  const corner = at < 0 ? inMiddle(desk, corners) : corners[(at + by + corners.length) % corners.length]!;
  bringIn(desk, corner);
  desk.deed = { what: "remove", corner, why: keeps(here.corners, [corner]) };
  desk.repaintLive();
  desk.tellDeed(corner.x, corner.y);
}

/** A new vertex half way from the one that is held to the next. */
export function pointBetween(desk: Desk): void {
  const here = desk.store.ui.tool === "vertices" ? pointsHere(desk.store) : null;
  if (!here) return;
  const corners = ordered(here.corners);
  const held = corners[now(desk, corners)];
  if (!held) return;
  const ring = here.contour.rings[held.ring]!;
  const next = Math.min(...corners.filter((corner) => corner.ring === held.ring && corner !== held).map((corner) => ahead(ring, held.s, corner.s)));
  const s = held.s + next / 2;
  const [x, y] = pointAt(ring, s);
  act(desk, { what: "add", place: { ring: held.ring, x, y, s } });
  desk.tellDeed(x, y);
}
