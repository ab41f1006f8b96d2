// How was the drawing read? A small dot where a stroke was joined to its parent, an amber ring where that is in doubt; and, on a turned page, the limbs.

import type { Limb, Mark } from "../../messages";
import type { PageCamera } from "../camera";
import type { Palette } from "./palette";

const DOT = 2; // CSS pixels
const RING = 4.5;

export function paintMarks(on: CanvasRenderingContext2D, camera: PageCamera, palette: Palette, marks: Mark[]): void {
  for (const mark of marks) {
    const [x, y] = camera.toScreen(mark.x, mark.y);
    on.beginPath();
    on.arc(x, y, mark.doubtful ? RING : DOT, 0, 2 * Math.PI);
    if (mark.doubtful) {
      on.fillStyle = palette.raised;
      on.fill();
      on.strokeStyle = palette.doubt;
      on.lineWidth = 2;
      on.stroke();
    } else {
      on.fillStyle = palette.accent;
      on.fill();
    }
  }
}

/** The doubtful mark under the pointer. */
export function doubtAt(marks: Mark[], camera: PageCamera, px: number, py: number): Mark | null {
  return marks.find((mark) => {
    const [x, y] = camera.toScreen(mark.x, mark.y);
    return mark.doubtful && Math.hypot(x - px, y - py) <= RING + 4;
  }) ?? null;
}

/** A limb that was drawn on another page, or adopted, as it is seen on this one. */
export function paintGuide(on: CanvasRenderingContext2D, camera: PageCamera, palette: Palette, limb: Limb, xy: number[], selected: boolean, cased: string | null = null): void {
  if (xy.length < 4) return;
  on.beginPath();
  on.moveTo(...camera.toScreen(xy[0]!, xy[1]!));
  for (let at = 2; at < xy.length; at += 2) on.lineTo(...camera.toScreen(xy[at]!, xy[at + 1]!));
  on.strokeStyle = selected ? palette.accent : palette.guide;
  on.lineWidth = (selected ? 3 : 2.5) / (1 + 0.3 * limb.order);
  if (cased !== null) { // over points, in this colour
    const [own, width] = [on.strokeStyle, on.lineWidth];
    on.strokeStyle = cased;
    on.lineWidth = width + 3;
    on.stroke();
    on.strokeStyle = own;
    on.lineWidth = width;
  }
  on.setLineDash(limb.strokes.length ? [] : [5, 4]);
  on.stroke();
  on.setLineDash([]);
}
