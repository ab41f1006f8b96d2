// What shows of the tree in the photo? Its limbs, as wide as they are, each with its line; and a tint where foliage is.

import type { TracedTree, Underlay } from "../../messages";
import type { PageCamera } from "../camera";
import type { Palette } from "./palette";

const LINE = 1.75; // CSS pixels: of what lies on a stroke
const FOUND = 1.25; // of what was found in the photo
const CASING = 1.5; // CSS pixels, each side
const BODY = 0.5; // how strong a limb's thickness is
const TINT = 0.24; // and the foliage

interface Shapes {
  body: Path2D;
  drawn: Path2D;
  found: Path2D;
}

const shapes = new WeakMap<TracedTree, Shapes>();

/** In page units; the canvas is set to them. `strength`: of a limb's thickness. */
export function paintTraced(on: CanvasRenderingContext2D, traced: { trees: TracedTree[] }, palette: Palette, scale: number, strength = BODY): void {
  for (const tree of traced.trees) {
    const { body, drawn, found } = shapesOf(tree);
    on.fillStyle = palette.traced;
    on.globalAlpha = strength;
    if (strength > 0) on.fill(body);
    on.globalAlpha = 1;
    for (const [line, width] of [[found, FOUND], [drawn, LINE]] as const) {
      on.strokeStyle = palette.paper;
      on.globalAlpha = 0.7;
      on.lineWidth = (width + 2 * CASING) / scale;
      on.stroke(line);
      on.globalAlpha = 1;
      on.strokeStyle = palette.traced;
      on.lineWidth = width / scale;
      on.stroke(line);
    }
  }
}

/** All limbs' thickness is one shape, whose pieces turn the same way round, so that it is evenly strong where they overlap. */
function shapesOf(tree: TracedTree): Shapes {
  const known = shapes.get(tree);
  if (known) return known;
  const made: Shapes = { body: new Path2D(), drawn: new Path2D(), found: new Path2D() };
  tree.parent.forEach((up, at) => {
    if (up >= 0) addPiece(made, tree, up, at);
  });
  shapes.set(tree, made);
  return made;
}

function addPiece({ body, drawn, found }: Shapes, { xy, width, drawn: isDrawn }: TracedTree, up: number, at: number): void {
  const [ax, ay, bx, by] = [xy[2 * up]!, xy[2 * up + 1]!, xy[2 * at]!, xy[2 * at + 1]!];
  const line = isDrawn[at] ? drawn : found;
  line.moveTo(ax, ay);
  line.lineTo(bx, by);
  const length = Math.hypot(bx - ax, by - ay);
  if (length === 0) return;
  const half = width[at]! / 2;
  const foot = width[up]! > 1.6 * width[at]! ? half : width[up]! / 2; // a branch is no wider where it leaves a thicker limb
  const [nx, ny] = [-(by - ay) / length, (bx - ax) / length];
  body.moveTo(ax + foot * nx, ay + foot * ny);
  body.lineTo(bx + half * nx, by + half * ny);
  body.lineTo(bx - half * nx, by - half * ny);
  body.lineTo(ax - foot * nx, ay - foot * ny);
  body.closePath();
  body.moveTo(bx + half, by);
  body.arc(bx, by, half, 0, 2 * Math.PI, true);
  body.closePath();
}

/** `tint`: the mask in the tint's colour. */
export function paintTint(on: CanvasRenderingContext2D, camera: PageCamera, underlay: Underlay, tint: CanvasImageSource): void {
  const [x, y] = camera.toScreen(underlay.x, underlay.y);
  on.globalAlpha = TINT;
  on.drawImage(tint, x, y, underlay.width * camera.scale, underlay.height * camera.scale);
  on.globalAlpha = 1;
}
