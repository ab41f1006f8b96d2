// What does a brush say about the photo: this is tree, this is not? Wide lines that one can see the photo through.

import type { Stroke } from "../../messages";
import type { Palette } from "../paint/palette";

const STRENGTH = 0.55;
const COLOURS: Partial<Record<Stroke["kind"], "traced" | "wrong">> = { foreground: "traced", matte_add: "traced", background: "wrong", matte_erase: "wrong" };

/** Is it said of a photo, and no part of a drawn tree? */
export function isScribble(stroke: Pick<Stroke, "kind">): boolean {
  return stroke.kind in COLOURS;
}

/** In page units. */
export function paintScribble(on: CanvasRenderingContext2D, stroke: Stroke, line: Path2D, palette: Palette, width: number): void {
  const colour = COLOURS[stroke.kind];
  if (!colour) return;
  on.strokeStyle = palette[colour];
  on.globalAlpha *= STRENGTH;
  on.lineWidth = width;
  on.stroke(line);
}
