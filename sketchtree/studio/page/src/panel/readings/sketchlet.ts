// How is one reading shown? Two tiny line drawings on one canvas: from the front, and from above. What differs from the tree one sees is in colour.

import type { Reading } from "../../messages";
import { element } from "../../parts/element";
import { differing } from "./differing";
import { twoViews } from "./two_views";

const WIDTH = 116;
const FRONT = 84; // CSS pixels, height
const ABOVE = 66;
const MARGIN = 5;
const TRUNK = 1.8; // CSS pixels, width of the first limb
const LIMB = 1.1;

/** The canvas, and what draws it again in the colours that hold now. `seen`: the reading of the tree on screen. */
export function sketchlet(reading: Reading, seen: Reading): { root: HTMLCanvasElement; draw: () => void } {
  const root = element("canvas", { class: "sketchlet", aria: { hidden: "true" } });
  const lines = twoViews(reading.paths, { width: WIDTH, height: FRONT, margin: MARGIN }, { width: WIDTH, height: ABOVE, margin: MARGIN });
  const other = differing(reading.paths, seen.paths);
  const draw = (): void => {
    const fine = Math.min(3, Math.max(1, devicePixelRatio));
    root.width = WIDTH * fine;
    root.height = (FRONT + ABOVE) * fine;
    const pen = root.getContext("2d");
    if (!pen) return;
    const style = getComputedStyle(root);
    const [ink, mark] = [style.color, style.getPropertyValue("--mark")];
    pen.scale(fine, fine);
    pen.lineCap = pen.lineJoin = "round";
    pen.strokeStyle = style.getPropertyValue("--line");
    pen.lineWidth = 1;
    stroke(pen, [MARGIN, FRONT, WIDTH - MARGIN, FRONT], 0);
    for (const marked of [false, true]) { // those that differ on top
      pen.strokeStyle = marked ? mark : ink;
      for (const [view, down] of [[lines.front, 0], [lines.above, FRONT]] as const)
        view.forEach((line, limb) => {
          if (other[limb] !== marked) return;
          pen.lineWidth = limb === 0 ? TRUNK : LIMB;
          stroke(pen, line, down);
        });
    }
  };
  return { root, draw };
}

function stroke(pen: CanvasRenderingContext2D, line: readonly number[], down: number): void {
  pen.beginPath();
  for (let i = 0; i + 1 < line.length; i += 2) pen.lineTo(line[i]!, line[i + 1]! + down);
  pen.stroke();
}
