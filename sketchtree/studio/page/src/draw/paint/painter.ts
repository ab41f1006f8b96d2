// What is on the page, from below to above? Paper, the picture to trace over, the ground, limbs of other pages, strokes, marks; and above all what is in hand.

import type { Stroke } from "../../messages";
import type { CloudPicture } from "../cloud/picture";
import { type Desk, here, isSamePage } from "../desk";
import { around } from "../line/nearness";
import { outline, widths } from "../line/outline";
import { photoHere } from "../photo";
import { projected } from "../turned";
import { paintGuide, paintMarks } from "./marks";
import { type Palette } from "./palette";
import { paintGrid, paintGround, paintUnderlay } from "./paper";
import { type Look, paintStroke, smooth, type State } from "./strokes";
import { paintTint, paintTraced } from "./traced";
import { paintBrush, paintHover, paintTrunk } from "../trunk/paint";
import { isScribble } from "../trunk/scribbles";
import { way } from "../trunk/way";

const BEHIND = 0.45; // how strong a photo is, at most, over its tree
const DEFAULT_WIDTH = 0.006; // of the drawing's height: strokes that have no width of their own

/** Everything that stays when the pen is lifted. */
export function paintDrawing(
  on: CanvasRenderingContext2D, ratio: number, desk: Desk, palette: Palette, picture: HTMLImageElement | null, tint: CanvasImageSource | null,
  mask: CanvasImageSource | null, cloud: CloudPicture,
): void {
  const { camera, store } = desk;
  const over = store.ui.layout === "over";
  clear(on, ratio);
  if (!over) paintGrid(on, camera, palette);
  const underlay = desk.underlay ?? store.known.underlay;
  const under = underlay !== null && picture !== null && isSamePage(store.ui.turn, 0);
  const seen = under && over && store.known.photoTree ? { ...underlay, opacity: Math.min(underlay.opacity, BEHIND) } : underlay; // the tree is below it
  if (under && seen) paintUnderlay(on, camera, palette, seen, picture, desk.movesUnderlay);
  if (!over) cloud.paint(on, ratio, camera, store, palette.paper); // else it stands beside the tree below
  const photo = photoHere(store);
  const scribbled = way(store) === "scribbles";
  if (photo && tint && store.ui.tint && !scribbled) paintTint(on, camera, underlay ?? photo, tint);
  if (!photo) paintGround(on, camera, palette, groundLevel(desk)); // it has ground of its own
  if (photo && scribbled) return paintTrunk(on, ratio, desk, desk.underlay ?? photo, mask, palette);
  if (!isSamePage(store.ui.turn, 0) || turnedStrokes(desk)) paintGuides(on, desk, palette);
  on.setTransform(ratio * camera.scale, 0, 0, ratio * camera.scale, ratio * camera.x, ratio * camera.y);
  const look: Look = { palette, scale: camera.scale, width: usualWidth(desk), cased: over || under || showsPoints(store) };
  const shownHere = here(store);
  const areasFirst = [...shownHere.filter((one) => one.kind !== "branch"), ...shownHere.filter((one) => one.kind === "branch")];
  const pointed = new Set(store.known.limbs.find((limb) => limb.id === store.ui.pointed)?.strokes);
  for (const stroke of areasFirst) paintOne(on, desk, look, stroke, pointed);
  if (photo && store.known.traced) paintTraced(on, store.known.traced, palette, camera.scale);
  on.setTransform(ratio, 0, 0, ratio, 0, 0);
  if (desk.instead.size === 0 && !photo) paintMarks(on, camera, palette, marksHere(desk));
}

function paintOne(on: CanvasRenderingContext2D, desk: Desk, look: Look, stroke: Stroke, pointed: ReadonlySet<string>): void {
  const instead = desk.instead.get(stroke.id);
  if (instead?.length === 0) return paintStroke(on, stroke, look, "faint");
  for (const one of instead ?? [stroke]) paintStroke(on, one, look, stateOf(desk, stroke, pointed));
}

function stateOf(desk: Desk, stroke: Stroke, pointed: ReadonlySet<string>): State {
  if (desk.trouble === stroke.id) return "wrong";
  if (desk.store.ui.selectedStrokes.includes(stroke.id)) return "selected";
  return desk.hovered === stroke.id || pointed.has(stroke.id) ? "hovered" : "plain";
}

/** What is in hand: the line being drawn, the lasso, the eraser. */
export function paintLive(on: CanvasRenderingContext2D, ratio: number, desk: Desk, palette: Palette): void {
  const { camera, live, lasso } = desk;
  clear(on, ratio);
  on.setTransform(ratio * camera.scale, 0, 0, ratio * camera.scale, ratio * camera.x, ratio * camera.y);
  if (live && !isScribble(live) && live.line.length > 1) paintInHand(on, live, palette, camera.scale);
  paintBrush(on, live && !isScribble(live) ? { ...desk, live: null } : desk, palette, camera.scale);
  if (lasso.length > 4) {
    on.strokeStyle = palette.accent;
    on.lineWidth = 1.25 / camera.scale;
    on.setLineDash([4 / camera.scale, 4 / camera.scale]);
    on.stroke(smooth(lasso, true));
    on.setLineDash([]);
  }
  paintEraser(on, desk, palette);
  on.setTransform(ratio, 0, 0, ratio, 0, 0);
  paintHover(on, desk, palette);
}

function paintEraser(on: CanvasRenderingContext2D, { eraser, camera }: Desk, palette: Palette): void {
  if (!eraser) return;
  on.beginPath();
  on.arc(eraser.x, eraser.y, eraser.radius, 0, 2 * Math.PI);
  on.strokeStyle = palette.soft;
  on.lineWidth = 1.25 / camera.scale;
  on.stroke();
}

function paintInHand(on: CanvasRenderingContext2D, live: NonNullable<Desk["live"]>, palette: Palette, scale: number): void {
  const xy = live.line.flatMap((sample) => [sample.x, sample.y]);
  if (live.kind === "branch") {
    on.fillStyle = palette.ink;
    on.fill(smooth(outline(xy, widths(live.line.length, live.width, live.pressed ? live.line.map((sample) => sample.pressure) : null, true)), true));
    return;
  }
  on.strokeStyle = live.kind === "crown" ? palette.crown : palette.obstacle;
  on.lineWidth = 2 / scale;
  on.stroke(smooth(xy, false));
  on.beginPath(); // how it will close
  on.moveTo(xy[xy.length - 2]!, xy[xy.length - 1]!);
  on.lineTo(xy[0]!, xy[1]!);
  on.globalAlpha = 0.5;
  on.setLineDash([3 / scale, 5 / scale]);
  on.stroke();
  on.setLineDash([]);
  on.globalAlpha = 1;
}

function paintGuides(on: CanvasRenderingContext2D, desk: Desk, palette: Palette): void {
  const { camera, store } = desk;
  const { tree, limbs } = store.known;
  if (!tree) return;
  for (const limb of limbs) {
    if (limb.strokes.length && isSamePage(limb.view_deg, store.ui.turn)) continue; // its ink is here
    if (store.ui.layout === "over" && limb.id !== store.ui.selected) continue; // the tree itself is below
    paintGuide(on, camera, palette, limb, projected(limb, tree, store.ui.turn), limb.id === store.ui.selected, showsPoints(store) ? palette.paper : null);
  }
}

/** Points of a scan lie behind the strokes, and are seen. */
function showsPoints({ known }: Desk["store"]): boolean {
  return known.scan !== null && known.points?.shown === true;
}

/** Some were drawn on another page. */
function turnedStrokes(desk: Desk): boolean {
  return desk.store.known.limbs.some((limb) => limb.strokes.length > 0 && !isSamePage(limb.view_deg, desk.store.ui.turn));
}

export function marksHere(desk: Desk): NonNullable<Desk["store"]["known"]["read"]>["marks"] {
  const { read, strokes } = desk.store.known;
  return (read?.marks ?? []).filter((mark) => {
    const stroke = strokes.get(mark.stroke);
    return stroke !== undefined && isSamePage(stroke.view_deg, desk.store.ui.turn);
  });
}

/** Where the ground is: at the tree's root; before there is one, at the foot of the drawing, or of an empty page. */
export function groundLevel(desk: Desk): number {
  const { tree, strokes, cloud } = desk.store.known;
  if (tree && strokes.size) return tree.root[1] ?? 0;
  if (cloud && !strokes.size) return cloud.y;
  const branches = [...strokes.values()].filter((stroke) => stroke.kind === "branch");
  const box = around(branches);
  return box ? box.top + box.height : 0;
}

function usualWidth(desk: Desk): number {
  const box = around(desk.store.known.strokes.values());
  return box ? Math.max(box.width, box.height) * DEFAULT_WIDTH : desk.store.ui.width;
}

function clear(on: CanvasRenderingContext2D, ratio: number): void {
  on.setTransform(1, 0, 0, 1, 0, 0);
  const half = Math.ceil(on.canvas.height / 2); // in halves: Chromium with software drawing may leave what a whole canvas showed before, where nothing is painted after
  on.clearRect(0, 0, on.canvas.width, half);
  on.clearRect(0, half, on.canvas.width, on.canvas.height - half);
  on.setTransform(ratio, 0, 0, ratio, 0, 0);
  on.lineCap = on.lineJoin = "round";
}
