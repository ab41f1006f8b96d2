// Scribbles over the photo: each kind in its colour, evenly strong however often they cross, with an edge that is seen on light and dark.

import type { Stroke } from "../../messages";
import type { PageCamera } from "../camera";
import type { Palette } from "../paint/palette";
import { smooth } from "../paint/strokes";
import { layerLike } from "./layer";
import { colourOf } from "./scribbles";

const EDGE = 1; // CSS pixels, each side
const FAINT = 0.3; // of one that is being erased
const LEAST = 2; // CSS pixels: none is thinner on screen

const lines = new WeakMap<Stroke, Path2D>();

/** `erased`: it goes when the pen is lifted. */
export function paintScribbles(
  on: CanvasRenderingContext2D, ratio: number, camera: PageCamera, strokes: readonly Stroke[], erased: (stroke: Stroke) => boolean, palette: Palette, strength: number,
): void {
  const layer = layerLike(on);
  if (!layer || !strokes.length) return;
  layer.setTransform(ratio * camera.scale, 0, 0, ratio * camera.scale, ratio * camera.x, ratio * camera.y);
  for (const edge of [true, false]) {
    for (const stroke of strokes) {
      if (edge && erased(stroke)) continue;
      layer.globalAlpha = erased(stroke) ? FAINT : 1;
      layer.strokeStyle = edge ? palette.handle : colourOf(stroke.kind, palette);
      layer.lineWidth = Math.max(stroke.width ?? 0, LEAST / camera.scale) + (edge ? (2 * EDGE) / camera.scale : 0);
      layer.stroke(lineOf(stroke));
    }
  }
  on.save();
  on.setTransform(1, 0, 0, 1, 0, 0);
  on.globalAlpha = strength;
  on.drawImage(layer.canvas, 0, 0);
  on.restore();
}

function lineOf(stroke: Stroke): Path2D {
  let line = lines.get(stroke);
  if (!line) lines.set(stroke, (line = smooth(stroke.xy, false)));
  return line;
}
