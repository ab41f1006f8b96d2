// How does a stroke look? A branch as ink whose width is the pen's; a crown as a soft green outline; an obstacle hatched. Shapes are made once a stroke.

import type { Stroke } from "../../messages";
import { outline, widths } from "../line/outline";
import { isScribble, paintScribble } from "../trunk/scribbles";
import type { Palette } from "./palette";

export interface Look {
  palette: Palette;
  scale: number; // CSS pixels a page unit
  width: number; // page units: of strokes that have none of their own
  cased: boolean; // with paper around the ink: the page is glass, and there are leaves behind it
}

export type State = "plain" | "hovered" | "selected" | "wrong" | "faint";

const HALO = 5; // CSS pixels around what is selected
const HALO_STRENGTH: Partial<Record<State, number>> = { selected: 0.32, hovered: 0.16, wrong: 0.22 };
const CASING = 1.3; // CSS pixels, each side
const LEAST = 1.1; // CSS pixels: no line is thinner on screen

interface Shape {
  ink: Path2D; // branch: its filled outline; else its line
  line: Path2D;
  width: number; // with what width it was made
}

const shapes = new WeakMap<Stroke, Shape>();

/** In page units; the canvas is set to them. */
export function paintStroke(on: CanvasRenderingContext2D, stroke: Stroke, look: Look, state: State): void {
  const shape = shapeOf(stroke, look);
  const { palette, scale } = look;
  on.globalAlpha = state === "faint" ? 0.22 : 1;
  if (state in HALO_STRENGTH) {
    on.strokeStyle = state === "wrong" ? palette.wrong : palette.accent;
    on.globalAlpha = HALO_STRENGTH[state] ?? 0;
    on.lineWidth = shape.width + (2 * HALO) / scale;
    on.stroke(shape.line);
    on.globalAlpha = 1;
  }
  if (isScribble(stroke)) {
    paintScribble(on, stroke, shape.line, palette, Math.max(shape.width, LEAST / scale));
    on.globalAlpha = 1;
    return;
  }
  if (look.cased && state !== "faint") paintCasing(on, shape, stroke.kind === "branch" ? shape.width : 2 / scale, look);
  if (stroke.kind === "branch") paintBranch(on, shape, state === "wrong" ? palette.wrong : palette.ink, scale);
  else paintArea(on, stroke, shape, look, state);
  on.globalAlpha = 1;
}

function paintCasing(on: CanvasRenderingContext2D, shape: Shape, width: number, { palette, scale }: Look): void {
  on.strokeStyle = palette.paper;
  on.globalAlpha = 0.62;
  on.lineWidth = Math.max(width, LEAST / scale) + (2 * CASING) / scale;
  on.stroke(shape.line);
  on.globalAlpha = 1;
}

function paintBranch(on: CanvasRenderingContext2D, shape: Shape, colour: string, scale: number): void {
  on.fillStyle = colour;
  on.fill(shape.ink);
  if (shape.width * scale < 2.5 * LEAST) { // from afar the tip would vanish
    on.strokeStyle = colour;
    on.lineWidth = LEAST / scale;
    on.stroke(shape.line);
  }
}

function paintArea(on: CanvasRenderingContext2D, stroke: Stroke, shape: Shape, { palette, scale }: Look, state: State): void {
  const crown = stroke.kind === "crown";
  const colour = state === "wrong" ? palette.wrong : crown ? palette.crown : palette.obstacle;
  on.fillStyle = crown ? palette.crownFill : hatching(on, colour, scale);
  on.fill(shape.line);
  on.strokeStyle = colour;
  on.lineWidth = (crown ? 2 : 1.75) / scale;
  if (crown) on.setLineDash([9 / scale, 5 / scale]);
  on.stroke(shape.line);
  on.setLineDash([]);
}

function shapeOf(stroke: Stroke, look: Look): Shape {
  const width = stroke.width ?? look.width;
  let shape = shapes.get(stroke);
  if (!shape || shape.width !== width) {
    const line = smooth(stroke.xy, stroke.closed);
    const count = stroke.xy.length / 2;
    const ink = stroke.kind === "branch" ? smooth(outline(stroke.xy, widths(count, width, stroke.pressure, true)), true) : line;
    shape = { ink, line, width };
    shapes.set(stroke, shape);
  }
  return shape;
}

const CORNER = Math.cos((40 * Math.PI) / 180); // a sharper turn is a corner, and stays one

/** A curve by the middles of a line's spans, bent towards its points; through corners it goes straight. */
export function smooth(xy: readonly number[], closed: boolean): Path2D {
  const path = new Path2D();
  const count = xy.length / 2;
  const x = (at: number): number => xy[2 * (at % count)]!;
  const y = (at: number): number => xy[2 * (at % count) + 1]!;
  if (closed) path.moveTo((x(0) + x(1)) / 2, (y(0) + y(1)) / 2);
  else path.moveTo(x(0), y(0));
  for (let at = 1; at < (closed ? count + 1 : count - 1); at += 1) {
    const [middleX, middleY] = [(x(at) + x(at + 1)) / 2, (y(at) + y(at + 1)) / 2];
    if (isCorner(x(at) - x(at - 1), y(at) - y(at - 1), x(at + 1) - x(at), y(at + 1) - y(at))) {
      path.lineTo(x(at), y(at));
      path.lineTo(middleX, middleY);
    } else path.quadraticCurveTo(x(at), y(at), middleX, middleY);
  }
  if (closed) path.closePath();
  else path.lineTo(x(count - 1), y(count - 1));
  return path;
}

function isCorner(ax: number, ay: number, bx: number, by: number): boolean {
  return ax * bx + ay * by < CORNER * Math.hypot(ax, ay) * Math.hypot(bx, by);
}

const hatches = new Map<string, CanvasPattern>();

function hatching(on: CanvasRenderingContext2D, colour: string, scale: number): CanvasPattern | string {
  let pattern = hatches.get(colour);
  if (!pattern) {
    const tile = document.createElement("canvas");
    tile.width = tile.height = 16;
    const ink = tile.getContext("2d")!;
    ink.strokeStyle = colour;
    ink.globalAlpha = 0.6;
    ink.lineWidth = 2;
    for (const shift of [-16, 0, 16]) {
      ink.moveTo(shift - 2, 18);
      ink.lineTo(shift + 18, -2);
    }
    ink.stroke();
    const made = on.createPattern(tile, "repeat");
    if (!made) return colour;
    pattern = made;
    hatches.set(colour, pattern);
  }
  pattern.setTransform(new DOMMatrix().scale(0.5 / scale));
  return pattern;
}
