// What does a brush say about the photo: this is tree, this is not? Wide lines that one can see the photo through.

import type { Stroke } from "../../messages";
import type { Palette } from "../paint/palette";

const STRENGTH = 0.55;
const COLOURS: Partial<Record<Stroke["kind"], "tree" | "beside">> = { foreground: "tree", matte_add: "tree", background: "beside", matte_erase: "beside" };

/** Is it said of a photo, and no part of a drawn tree? */
export function isScribble(stroke: Pick<Stroke, "kind">): boolean {
  return stroke.kind in COLOURS;
}

/** Is it painted into the matte that comes of the others, or out of it? */
export function isPaint(stroke: Pick<Stroke, "kind">): boolean {
  return stroke.kind === "matte_add" || stroke.kind === "matte_erase";
}

/** Which sides are scribbled on. */
export function sides(strokes: Iterable<Pick<Stroke, "kind">>): { tree: boolean; beside: boolean } {
  const kinds = new Set([...strokes].map(({ kind }) => kind));
  return { tree: kinds.has("foreground"), beside: kinds.has("background") };
}

export function colourOf(kind: Stroke["kind"], palette: Palette): string {
  return palette[COLOURS[kind] ?? "ink"];
}

/** In page units. */
export function paintScribble(on: CanvasRenderingContext2D, stroke: Stroke, line: Path2D, palette: Palette, width: number): void {
  on.strokeStyle = colourOf(stroke.kind, palette);
  on.globalAlpha *= STRENGTH;
  on.lineWidth = width;
  on.stroke(line);
}
