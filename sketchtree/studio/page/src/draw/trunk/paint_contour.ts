// The contour over the photo, its vertices as handles of an even size on screen, what was done to them by hand, and what a press would do.

import type { Trunks, Underlay } from "../../messages";
import type { PageCamera } from "../camera";
import type { Palette } from "../paint/palette";
import { type Contour, type Corner, gridOf, lineAlong, nearestPlace, wayBetween } from "./contour";
import type { Edits } from "./edits";
import { type Deed, why } from "./points";

const LARGEST = 6; // CSS pixels: radius of a handle where there is room
const SMALLEST = 2.25;
const ROOM = 0.14; // of the way between two
const DARK = "#1b1d1b"; // on a photo it is the same, light or dark
const SOFT = "#6b6c64";
const WRONG = "#a5281b";
const CROSS = 3.5; // CSS pixels

interface Screen {
  on: CanvasRenderingContext2D;
  palette: Palette;
  radius: number;
  at: (x: number, y: number) => [number, number]; // pixels of the photo → CSS pixels
}

/** The canvas is set to CSS pixels. */
export function paintContour(
  on: CanvasRenderingContext2D, camera: PageCamera, underlay: Underlay, found: Trunks, contour: Contour, corners: readonly Corner[], edits: Edits, palette: Palette,
): void {
  const screen = screenOf(on, camera, underlay, found, contour, corners.length, palette);
  on.beginPath();
  for (const ring of contour.rings) {
    trace(screen, ring.xy);
    on.closePath();
  }
  twice(on, palette, 1);
  on.setLineDash([4, 4]);
  for (const [one, other] of edits.merge) {
    const [from, to] = [nearestPlace(contour, ...one), nearestPlace(contour, ...other)];
    if (from && to && from.ring === to.ring) strokeSpan(screen, contour, from, to, palette.handleEdge, 2.5);
  }
  on.setLineDash([]);
  for (const [x, y] of edits.remove) cross(screen, x, y, WRONG, 1.5);
  for (const corner of corners) handle(screen, corner);
}

/** Above all else: what the pen would do. */
export function paintDeed(
  on: CanvasRenderingContext2D, camera: PageCamera, underlay: Underlay, found: Trunks, contour: Contour, corners: readonly Corner[], deed: Deed, palette: Palette,
): void {
  const screen = screenOf(on, camera, underlay, found, contour, corners.length, palette);
  const not = why(deed) !== null;
  switch (deed.what) {
    case "remove":
      ring(screen, deed.corner.x, deed.corner.y, not ? SOFT : WRONG);
      if (!not) cross(screen, deed.corner.x, deed.corner.y, WRONG, 2);
      break;
    case "add": ring(screen, deed.place.x, deed.place.y, palette.handleEdge); plus(screen, deed.place.x, deed.place.y); break;
    case "restore": ring(screen, deed.point[0], deed.point[1], palette.handleEdge); break;
    case "merge":
      if (deed.from.ring === deed.to.ring) strokeSpan(screen, contour, deed.from, deed.to, not ? SOFT : palette.handleEdge, 3);
      for (const end of [deed.from, deed.to]) ring(screen, end.x, end.y, not ? SOFT : palette.handleEdge);
      if (!not) for (const corner of deed.gone) cross(screen, corner.x, corner.y, WRONG, 2);
      break;
  }
}

function screenOf(on: CanvasRenderingContext2D, camera: PageCamera, underlay: Underlay, found: Trunks, contour: Contour, count: number, palette: Palette): Screen {
  const grid = gridOf(found, underlay);
  const around = contour.rings.reduce((sum, ring) => sum + ring.length, 0) * grid.unit * camera.scale;
  const radius = Math.min(LARGEST, Math.max(SMALLEST, (ROOM * around) / Math.max(1, count)));
  return { on, palette, radius, at: (x, y) => camera.toScreen(grid.left + x * grid.unit, grid.top + y * grid.unit) };
}

function trace({ on, at }: Screen, xy: readonly number[]): void {
  for (let point = 0; point + 1 < xy.length; point += 2) {
    const [x, y] = at(xy[point]!, xy[point + 1]!);
    if (point === 0) on.moveTo(x, y);
    else on.lineTo(x, y);
  }
}

/** Dark below, light above: seen on any photo. */
function twice(on: CanvasRenderingContext2D, { handle }: Palette, width: number): void {
  on.strokeStyle = DARK;
  on.globalAlpha = 0.55;
  on.lineWidth = width + 2;
  on.stroke();
  on.globalAlpha = 1;
  on.strokeStyle = handle;
  on.lineWidth = width;
  on.stroke();
}

function strokeSpan(screen: Screen, contour: Contour, one: { ring: number; x: number; y: number; s: number }, other: typeof one, colour: string, width: number): void {
  const { on } = screen;
  const { from, long } = wayBetween(contour, one, other);
  on.beginPath();
  trace(screen, lineAlong(contour.rings[one.ring]!, from, long));
  on.strokeStyle = colour;
  on.lineWidth = width;
  on.stroke();
}

/** One that parts the contour is large; one that does not is a dot; one that was added is filled. */
function handle({ on, palette, radius, at }: Screen, { x, y, parts, added }: Corner): void {
  on.beginPath();
  on.arc(...at(x, y), parts ? radius : 0.6 * radius, 0, 2 * Math.PI);
  on.fillStyle = added ? palette.handleEdge : palette.handle;
  on.globalAlpha = parts ? 1 : 0.75;
  on.fill();
  on.strokeStyle = added ? palette.handle : palette.handleEdge;
  on.lineWidth = parts ? 1.75 : 1.25;
  on.stroke();
  on.globalAlpha = 1;
}

function ring({ on, palette, radius, at }: Screen, x: number, y: number, colour: string): void {
  for (const [stroke, width] of [[palette.handle, 4.5], [colour, 2.25]] as const) {
    on.beginPath();
    on.arc(...at(x, y), radius + 3, 0, 2 * Math.PI);
    on.strokeStyle = stroke;
    on.lineWidth = width;
    on.stroke();
  }
}

function cross({ on, palette, at }: Screen, x: number, y: number, colour: string, width: number): void {
  const [left, top] = at(x, y);
  on.beginPath();
  for (const way of [-1, 1]) {
    on.moveTo(left - CROSS, top - way * CROSS);
    on.lineTo(left + CROSS, top + way * CROSS);
  }
  for (const [stroke, wide] of [[palette.handle, width + 2], [colour, width]] as const) {
    on.strokeStyle = stroke;
    on.lineWidth = wide;
    on.stroke();
  }
}

function plus({ on, palette, at }: Screen, x: number, y: number): void {
  const [left, top] = at(x, y);
  on.beginPath();
  on.moveTo(left - CROSS, top);
  on.lineTo(left + CROSS, top);
  on.moveTo(left, top - CROSS);
  on.lineTo(left, top + CROSS);
  on.strokeStyle = palette.handleEdge;
  on.lineWidth = 2;
  on.stroke();
}
