// What is seen of scribbles, matte and trunk, by the tool in hand? Scribbling: scribbles over a tint. Painting: the tint alone. Points: the contour, its handles and the trunk as thick as it is.

import type { Stroke, Underlay } from "../../messages";
import { type Desk, here } from "../desk";
import type { Palette } from "../paint/palette";
import { paintTraced } from "../paint/traced";
import { paintMask } from "./mask";
import { paintContour, paintDeed } from "./paint_contour";
import { paintScribbles } from "./paint_scribbles";
import { pointsHere } from "./points";
import { gridOf } from "./contour";
import { colourOf, isPaint } from "./scribbles";
import { isScribbled } from "./way";

const SCRIBBLES = 0.72; // how strong they are
const ASIDE = 0.35; // of a tint that is not looked at just now
const RING = "#1b1d1b"; // of the brush, round the light one
const BODY = 0.3; // how strong a limb's thickness is

/** Above the photo; nothing is in page units before or after. */
export function paintTrunk(on: CanvasRenderingContext2D, ratio: number, desk: Desk, underlay: Underlay, mask: CanvasImageSource | null, palette: Palette): void {
  const { camera, store } = desk;
  const { tool, matteView, matteStrength, skeleton } = store.ui;
  const known = isScribbled(store) ? mask : null; // else it is of scribbles that are gone
  const strokes = here(store).flatMap((stroke) => desk.instead.get(stroke.id)?.length ? desk.instead.get(stroke.id)! : [stroke]);
  const painted = strokes.filter((stroke) => isPaint(stroke) && !isErased(desk, stroke));
  if (known && matteView !== "off") {
    const strength = tool === "vertices" ? ASIDE * matteStrength : matteStrength;
    paintMask(on, ratio, camera, underlay, known, painted, { alone: matteView === "alone", colour: palette.matte, strength });
  }
  const seen = scribblesSeen(desk, strokes, known !== null);
  paintScribbles(on, ratio, camera, seen, (stroke) => isErased(desk, stroke), palette, SCRIBBLES);
  if (skeleton && isScribbled(store)) paintFound(on, ratio, desk, palette, underlay);
}

function isErased(desk: Desk, { id }: Stroke): boolean {
  return desk.instead.get(id)?.length === 0;
}

/** What is painted shows in the matte; as lines only where they can be erased, or there is no matte yet. */
function scribblesSeen({ store }: Desk, strokes: readonly Stroke[], hasMatte: boolean): Stroke[] {
  const { tool, matteView } = store.ui;
  if (tool === "erase") return [...strokes];
  if (tool === "vertices" || tool === "foot") return [];
  const paints = tool === "matte_add" || tool === "matte_erase";
  return strokes.filter((stroke) => (isPaint(stroke) ? !hasMatte || matteView === "off" : !paints));
}

function paintFound(on: CanvasRenderingContext2D, ratio: number, desk: Desk, palette: Palette, underlay: Underlay): void {
  const { camera, store } = desk;
  const { found, trunk } = store.known;
  if (!found) return;
  const points = store.ui.tool === "vertices";
  on.setTransform(ratio * camera.scale, 0, 0, ratio * camera.scale, ratio * camera.x, ratio * camera.y);
  paintTraced(on, found, palette, camera.scale, points ? BODY : 0);
  on.setTransform(ratio, 0, 0, ratio, 0, 0);
  const here = points ? pointsHere(store) : null;
  if (here) paintContour(on, camera, underlay, found, here.contour, here.corners, here.edits, palette);
  if (trunk?.root) paintFoot(on, desk, underlay, trunk.root, palette);
}

/** A pin where it stands, if that was said. */
function paintFoot(on: CanvasRenderingContext2D, { camera, store }: Desk, underlay: Underlay, root: [number, number], palette: Palette): void {
  const grid = gridOf(store.known.found!, underlay);
  const [x, y] = camera.toScreen(grid.left + root[0] * grid.unit, grid.top + root[1] * grid.unit);
  on.beginPath();
  on.moveTo(x, y);
  on.lineTo(x - 6, y + 11);
  on.lineTo(x + 6, y + 11);
  on.closePath();
  on.fillStyle = palette.handleEdge;
  on.strokeStyle = palette.handle;
  on.lineWidth = 1.5;
  on.fill();
  on.stroke();
}

/** What is in hand. The canvas is set to page units, and left so. */
export function paintBrush(on: CanvasRenderingContext2D, { live, ring, store }: Desk, palette: Palette, scale: number): void {
  if (live && live.line.length) {
    on.beginPath();
    live.line.forEach(({ x, y }, at) => (at ? on.lineTo(x, y) : on.moveTo(x, y)));
    if (live.line.length === 1) on.lineTo(live.line[0]!.x, live.line[0]!.y);
    const paints = isPaint(live);
    on.strokeStyle = live.kind === "matte_add" ? palette.matte : colourOf(live.kind, palette);
    on.globalAlpha = paints ? store.ui.matteStrength : SCRIBBLES;
    on.lineWidth = live.width;
    on.stroke();
    on.globalAlpha = 1;
  }
  if (!ring) return;
  for (const [colour, width] of [[RING, 2.5], [palette.handle, 1]] as const) {
    on.beginPath();
    on.arc(ring.x, ring.y, ring.radius, 0, 2 * Math.PI);
    on.strokeStyle = colour;
    on.globalAlpha = colour === RING ? 0.5 : 1;
    on.lineWidth = width / scale;
    on.stroke();
  }
  on.globalAlpha = 1;
}

/** What a press would do to the contour. The canvas is set to CSS pixels. */
export function paintHover(on: CanvasRenderingContext2D, desk: Desk, palette: Palette): void {
  const { store, camera, deed } = desk;
  const { underlay, found } = store.known;
  const here = store.ui.tool === "vertices" && deed ? pointsHere(store) : null;
  if (here && deed && underlay && found) paintDeed(on, camera, underlay, found, here.contour, here.corners, deed, palette);
}
